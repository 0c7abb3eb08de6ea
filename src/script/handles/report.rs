//! Report entry of a simulation.

use rhai::Dynamic;
use serde_json::{Value, json};

use super::simulation::SimulationHandle;
use crate::geometry::Vec2;
use crate::output::CsvTable;
use crate::script::messages::reports::Reporter;
use crate::simulation::{History, Invariant};

impl Reporter for SimulationHandle {
    fn report(&self) -> Value {
        let simulation = self.simulation();
        let (counts, history, settings) =
            (simulation.counts(), simulation.history(), simulation.settings());
        let energy = history.samples().last().map(|row| row.measures.energy).unwrap_or_default();
        let (scene, model) = (simulation.scene(), simulation.model());
        let points = |(x, y): (f64, f64), angle: f64| json!({ "x": x, "y": y, "angle": angle });
        let ends = scene.beams.iter().zip(model.control_points()).enumerate().map(|(index, (beam, controls))| {
            let (start, end) = model.end_angles(index);
            let at = |point: Option<&Vec2>| point.map_or((f64::NAN, f64::NAN), |point| (point.x, point.y));
            (beam.name.clone(), json!({ "start": points(at(controls.first()), start), "end": points(at(controls.last()), end) }))
        });
        let basis: Vec<String> = model.meshes().iter().map(|mesh| mesh.describe()).collect();
        let drift: serde_json::Map<String, Value> = Invariant::ALL
            .iter()
            .map(|(name, of)| ((*name).to_owned(), json!(history.drift(*of))))
            .collect();
        let slider = |(index, name): (usize, &str)| {
            let force = model.contact_force(index);
            json!({
                "name": name,
                "position": model.slider_position(index),
                "speed": model.slider_speed(index),
                "force": [force.x, force.y],
                "state": model.slider_state(index).name(),
                "most_spans_in_a_step": model.most_spans(index),
                "impacts_per_step": model.impacts_per_step(index),
            })
        };
        let notes: Vec<String> = simulation.warnings().iter().map(ToString::to_string).collect();
        let resolution = json!({
            "unresolved_share": model.resolution().unresolved_share(),
            "turn_in_a_step": model.resolution().angular_frequency() * simulation.dt(),
            "rotation_in_a_step": model.resolution().rotation(),
        });
        json!({
            "name": self.name(),
            "steps": counts.steps,
            "newton_iterations": counts.newton_iterations,
            "corrections": counts.corrections,
            "newton_max": counts.newton_max,
            "factorisations": counts.factorisations,
            "retries": counts.retries,
            "wall_s": counts.wall.as_secs_f64(),
            "unknowns": simulation.unknowns(),
            "half_bandwidth": simulation.half_bandwidth(),
            "basis": basis.join("; "),
            "integrator": settings.method.entry().name,
            "rejected": counts.rejected,
            "dt": simulation.dt(),
            "step_size": settings.dt.to_string(),
            "t": simulation.time(),
            "notes": notes,
            "resolution": resolution,
            "drift": drift,
            "energy": {
                "kinetic": energy.kinetic, "strain": energy.strain, "potential": energy.potential, "total": energy.total(),
            },
            "ended": simulation.ending(),
            "events": simulation.arrivals().len(),
            "sliders": model.slider_names().enumerate().map(slider).collect::<Vec<_>>(),
            "ends": ends.collect::<serde_json::Map<_, _>>(),
        })
    }

    fn object(&self) -> Dynamic {
        Dynamic::from(self.clone())
    }

    fn is_in_use(&self) -> bool {
        self.is_shared()
    }

    fn remains(&self, numbers: usize) -> Option<(String, String)> {
        let simulation = self.simulation();
        let table = (simulation.counts().steps > 0)
            .then(|| history_table(self.name(), simulation.history()).thinned(numbers))?;
        let plain = |letter: char| if letter.is_alphanumeric() { letter } else { '-' };
        let name: String = self.name().chars().map(plain).collect();
        let part = if self.was_stopped() { "stopped" } else { "history" };
        Some((format!("{name}-{part}.csv"), table.to_text().ok()?))
    }
}

pub fn history_table(name: &str, history: &History) -> CsvTable {
    let table = CsvTable::new().comment(format!("simulation: {name}"));
    history.columns().fold(table, |table, (column, dimension)| {
        let values = history.column(column).unwrap_or_default();
        table.column(format!("{column} [{dimension}]"), values)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::{DriftScales, ExtraColumn, Sample};

    #[test]
    fn history_table_contains_extra_columns() {
        let extra = vec![ExtraColumn { name: "slider.force".into(), dimension: "force" }];
        let mut history = History::new(DriftScales::default(), extra);
        history.push(Sample::default(), std::iter::once(2.0));
        let table = history_table("rod", &history);
        assert_eq!(table.columns.len(), History::COLUMNS.len() + 1);
        assert_eq!(table.columns.last(), Some(&("slider.force [force]".into(), vec![2.0])));
    }
}
