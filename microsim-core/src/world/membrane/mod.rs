//! What changes membranes: growth, division, fusion.

mod division;
mod fusion;
mod growth;
mod transfer;
