//! Bacillus: a dense rod, such as *Escherichia coli*.

use crate::microscope::matter::Matter;

pub(super) const LOOK: Matter = Matter { phase: 0.9, haemoglobin: 0.0, cytoplasm: 0.3, nucleus: 0.9 };
