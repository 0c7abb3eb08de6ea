//! Summaries of simulations and histories.

use super::entries::{line, listed, number, pair};
use crate::output::{scientific, significant};
use crate::script::bindings::kind::Details;
use crate::simulation::{History, Invariant, Simulation, StepSize};

const SLIDERS: usize = 2;

pub fn of_simulation(simulation: &Simulation) -> Details {
    let (counts, settings) = (simulation.counts(), simulation.settings());
    let row = simulation.history().samples().last().map(|row| row.measures).unwrap_or_default();
    let mean = counts.newton_iterations as f64 / counts.steps.max(1) as f64;
    let iterations = format!("{} a step, at most {}", significant(mean, 3), counts.newton_max);
    let energy = format!("{}, work of loads {}", number(row.energy.total()), number(row.work));
    let parts = format!(
        "kinetic {}, strain {}, potential {}",
        number(row.energy.kinetic),
        number(row.energy.strain),
        number(row.energy.potential)
    );
    let drift = |of| scientific(simulation.history().drift(of), 2);
    let drifts = format!(
        "energy {}, momentum {}, angular momentum {}",
        drift(Invariant::Energy),
        drift(Invariant::Momentum),
        drift(Invariant::AngularMomentum)
    );
    let retries = match counts.retries {
        0 => String::new(),
        retries => format!(", {retries} tried again"),
    };
    let rejected = match settings.dt {
        StepSize::Fixed(_) => String::new(),
        StepSize::Adaptive(_) => format!(", {} rejected", counts.rejected),
    };
    let mut details = vec![
        line(
            "time",
            format!("t = {}, dt = {}", number(simulation.time()), number(simulation.dt())),
        ),
        line("steps", format!("{}{rejected}{retries}", counts.steps)),
        line("Newton iterations", iterations),
        line("energy", energy),
        line("its parts", parts),
        line(
            "momentum",
            format!("{}, angular {}", pair(row.momentum), number(row.angular_momentum)),
        ),
        line("largest drift", drifts),
    ];
    if !simulation.scene().joints.is_empty() || !simulation.scene().sliders.is_empty() {
        details.push(line("gap", scientific(row.gap, 2)));
    }
    details.extend(sliders(simulation));
    details.extend(simulation.ending().map(|ending| line("ended", ending)));
    details
}

fn sliders(simulation: &Simulation) -> Details {
    let model = simulation.model();
    let slider = |(index, name): (usize, &str)| {
        let place = number(model.slider_position(index));
        let (force, state) = (pair(model.contact_force(index)), model.slider_state(index).name());
        line(&format!("slider '{name}'"), format!("{state} at {place}, force {force}"))
    };
    let mut lines: Details = model.slider_names().enumerate().take(SLIDERS).map(slider).collect();
    let rest = model.slider_names().count().saturating_sub(SLIDERS);
    lines.extend((rest > 0).then(|| line("more sliders", rest.to_string())));
    lines
}

pub fn of_history(history: &History) -> Details {
    let samples = history.samples();
    let ends = samples.first().zip(samples.last()).map(|(a, b)| (a.measures, b.measures));
    let from_to = |(a, b): (f64, f64)| format!("{} … {}", number(a), number(b));
    let mut details = vec![line("rows", samples.len().to_string())];
    if let Some((first, last)) = ends {
        let energies = (first.energy.total(), last.energy.total());
        details.push(line("times", from_to((first.time, last.time))));
        details.push(line("total energy", from_to(energies)));
    }
    let fixed: Vec<_> = history.columns().take(History::COLUMNS.len()).collect();
    let mut dimensions: Vec<&str> = Vec::new();
    for (_, dimension) in &fixed {
        if !dimensions.contains(dimension) {
            dimensions.push(dimension);
        }
    }
    for dimension in dimensions {
        let names = fixed.iter().filter(|(_, other)| *other == dimension).map(|(name, _)| *name);
        details.push(line(&format!("[{dimension}]"), names.collect::<Vec<_>>().join(", ")));
    }
    let extra: Vec<String> =
        history.columns().skip(fixed.len()).map(|(name, of)| format!("{name} [{of}]")).collect();
    if !extra.is_empty() {
        details.push(line("of parts, sensors", listed(extra.into_iter())));
    }
    details
}
