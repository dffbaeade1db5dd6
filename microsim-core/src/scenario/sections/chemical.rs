//! Chemicals: the tables `[chemical.NAME]`, and the fields `secretes` and `takes_up` of organisms.

use crate::collision::obstacle::Obstacle;
use crate::scenario::reader::{Fields, Read, ReadContext, SpannedValue, ValueType, join, mismatch};
use crate::{ChemicalId, ChemicalSpec, Exchange, WorldConfig};
use glam::Vec2;

/// Most cells of chemicals in the boxes of all obstacles together: each is tried whether it lies in the obstacle.
const MAX_CELLS_IN_OBSTACLES: f32 = 16e6;

/// Chemicals with their names, in the order in which the world gets them.
pub(crate) type Chemicals = Vec<(String, ChemicalSpec)>;

/// Reads all chemicals of a file.
pub(crate) fn read(root: &mut Fields<'_>, config: &WorldConfig, obstacles: &[Obstacle]) -> Chemicals {
    let (mut chemicals, mut cells) = (Chemicals::new(), Some(0));
    for (name, mut fields) in root.named("chemical") {
        let default = ChemicalSpec::default();
        let spec = ChemicalSpec {
            diffusion: fields.or("diffusion", default.diffusion),
            decay: fields.or("decay", default.decay),
            spacing: fields.or("spacing", default.spacing),
            initial: fields.or("initial", default.initial),
        };
        let own = fields.context.check(&fields.path, spec.cells_beside(cells.unwrap_or_default(), config));
        cells = cells.zip(own).map(|(others, own)| others + own);
        fields.finish();
        chemicals.push((name, spec));
    }
    if cells.is_some() && !is_soon_closed(&chemicals, config, obstacles) {
        let accepted =
            format!("at most {MAX_CELLS_IN_OBSTACLES} cells of chemicals in the boxes of obstacles, all together");
        root.refuse("chemical", "there are too many cells in obstacles", accepted);
    }
    chemicals
}

/// Whether there are few enough cells to try in obstacles.
fn is_soon_closed(chemicals: &Chemicals, config: &WorldConfig, obstacles: &[Obstacle]) -> bool {
    let boxes: Vec<[f32; 2]> = obstacles
        .iter()
        .filter(|obstacle| obstacle.stops_chemicals())
        .map(|obstacle| {
            let bounds = obstacle.aabb();
            (bounds.maxs.min(config.size) - bounds.mins.max(Vec2::ZERO)).max(Vec2::ZERO).to_array()
        })
        .collect();
    // A row and a column more than fit on every side, as cells that are only touched are tried, too.
    let cells = |[width, height]: [f32; 2], spacing: f32| (width / spacing + 3.0) * (height / spacing + 3.0);
    let mut left = MAX_CELLS_IN_OBSTACLES;
    chemicals.iter().all(|(_, spec)| {
        boxes.iter().all(|&size| {
            left -= cells(size, spec.spacing);
            left >= 0.0
        })
    })
}

/// The chemical of the name at a path; reports it if there is none.
pub(crate) fn find(name: &str, path: &str, chemicals: &Chemicals, context: &ReadContext<'_>) -> Option<ChemicalId> {
    let found = (0..).zip(chemicals).find(|(_, (known, _))| known == name).map(|(k, _)| ChemicalId(k));
    if found.is_none() {
        context.refuse_unknown(path, "chemical", name, chemicals.iter().map(|(name, _)| name.as_str()));
    }
    found
}

/// Reads the fields `secretes` and `takes_up` of a `[[spawn]]` table.
pub(crate) fn read_exchanges(fields: &mut Fields<'_>, chemicals: &Chemicals) -> Vec<Exchange> {
    let mut exchanges: Vec<Exchange> = Vec::new();
    for field in ["secretes", "takes_up"] {
        let Rates(rates) = fields.or(field, Rates(Vec::new()));
        for (name, rate) in rates {
            let path = join(&fields.at(field), &name);
            let Some(chemical) = find(&name, &path, chemicals, fields.context) else { continue };
            let known = exchanges.iter().position(|exchange| exchange.chemical == chemical);
            let at = known.unwrap_or_else(|| {
                exchanges.push(Exchange { chemical, secretion: 0.0, uptake: 0.0 });
                exchanges.len() - 1
            });
            let place = if field == "secretes" { &mut exchanges[at].secretion } else { &mut exchanges[at].uptake };
            if fields.is_within(&join(field, &name), rate, [0.0, 1e6]) {
                *place = rate;
            }
        }
    }
    exchanges
}

/// A number for each of some chemicals.
struct Rates(Vec<(String, f32)>);

impl Read for Rates {
    fn accepted() -> String {
        "{ CHEMICAL = NUMBER }".to_owned()
    }

    fn value_type() -> ValueType {
        ValueType::Table(Box::new(ValueType::Number))
    }

    fn written(&self) -> String {
        let rates = self.0.iter().map(|(name, rate)| format!("{name} = {}", rate.written()));
        format!("{{ {} }}", rates.collect::<Vec<_>>().join(", "))
    }

    fn read(value: &SpannedValue<'_>, path: &str, context: &ReadContext<'_>) -> Option<Self> {
        let Some(table) = value.get_ref().as_table() else { return mismatch(value, path, context) };
        let rates = table.iter().map(|(name, rate)| {
            let name = name.get_ref().to_string();
            f32::read(rate, &join(path, &name), context).map(|rate| (name, rate))
        });
        rates.collect::<Option<_>>().map(Self)
    }
}
