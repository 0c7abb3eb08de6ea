//! Columns of a history: standard columns, and columns of the scene.

use super::Sample;
use crate::integrators::Method;
use crate::joints::{Component, Slider};
use crate::loads::Load;
use crate::system::{Drive, DriveKind, DriveState, Scene, Spring, SpringKind, SpringState, System};

/// Standard column of every history.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// Name of the column.
    pub name: &'static str,
    /// Dimension of the values.
    pub dimension: &'static str,
    /// Function that reads the value from a row.
    pub value: fn(&Sample) -> f64,
}

/// Column whose presence depends on the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExtraColumn {
    /// Name: object and quantity, such as `slider1.force`.
    pub name: String,
    /// Dimension of the values.
    pub dimension: &'static str,
}

/// Standard columns, in their order.
pub(super) const FIXED: &[Column] = &[
    fixed("t", "time", |row| row.measures.time),
    fixed("kinetic", "energy", |row| row.measures.energy.kinetic),
    fixed("strain", "energy", |row| row.measures.energy.strain),
    fixed("potential", "energy", |row| row.measures.energy.potential),
    fixed("energy", "energy", |row| row.measures.energy.total()),
    fixed("work", "energy", |row| row.measures.work),
    fixed("momentum_x", "mass·length/time", |row| row.measures.momentum.x),
    fixed("momentum_y", "mass·length/time", |row| row.measures.momentum.y),
    fixed("impulse_x", "mass·length/time", |row| row.measures.impulse.x),
    fixed("impulse_y", "mass·length/time", |row| row.measures.impulse.y),
    fixed("angular_momentum", "mass·length²/time", |row| row.measures.angular_momentum),
    fixed("angular_impulse", "mass·length²/time", |row| row.measures.angular_impulse),
    fixed("gap", "length", |row| row.measures.gap),
    fixed("dt", "time", |row| row.dt),
    fixed("newton_iterations", "-", |row| row.newton_iterations as f64),
    fixed("retries", "-", |row| row.retries as f64),
];

const fn fixed(name: &'static str, dimension: &'static str, value: fn(&Sample) -> f64) -> Column {
    Column { name, dimension, value }
}

/// Columns of each slider: quantity and dimension.
const OF_SLIDER: [(&str, &str); 5] = [
    ("position", "-"),
    ("speed", "length/time"),
    ("force", "force"),
    ("force_x", "force"),
    ("force_y", "force"),
];

/// Column of each slider with friction.
const FRICTION: (&str, &str) = ("friction", "force");

/// Column of the energy stored in springs.
const STORED: &str = "stored";

/// Column of the energy dissipated by dampers, damped materials and drag.
const DISSIPATED: &str = "dissipated";

pub(super) fn extra_columns(scene: &Scene) -> Vec<ExtraColumn> {
    let of_slider = |slider: &Slider| {
        let name = slider.name.clone();
        let friction = (slider.friction > 0.0).then_some(FRICTION);
        OF_SLIDER.into_iter().chain(friction).map(move |(quantity, dimension)| ExtraColumn {
            name: format!("{name}.{quantity}"),
            dimension,
        })
    };
    let column = |name: String, dimension| ExtraColumn { name, dimension };
    let of_spring = |spring: &Spring| {
        let (name, kind) = (&spring.name, &spring.kind);
        let (measure, length, force) = match kind {
            SpringKind::Length(_) => ("length", "length", "force"),
            SpringKind::Torsion(_) => ("angle", "rad", "force·length"),
        };
        let of_ledger =
            [STORED, DISSIPATED].map(|entry| column(format!("{entry}.{name}"), "energy"));
        let own =
            [column(format!("{name}.{measure}"), length), column(format!("{name}.force"), force)];
        own.into_iter().chain(of_ledger).collect::<Vec<_>>()
    };
    let stores = scene.springs().next().is_some();
    let dissipates = stores || scene.dissipating().next().is_some();
    let sums = [(STORED, stores), (DISSIPATED, dissipates)].into_iter().filter(|(_, has)| *has);
    let sums = sums.map(|(entry, _)| column(entry.to_owned(), "energy"));
    let others = scene.dissipating().map(|name| column(format!("{DISSIPATED}.{name}"), "energy"));
    let of_drive = |drive: &Drive| {
        let name = &drive.name;
        let own = drive.motions().map(|(component, _)| {
            let dimension = match component {
                Component::X | Component::Y => "force",
                Component::Rotation => "force·length",
            };
            column(format!("{name}.{}", column_suffix(drive.kind, component)), dimension)
        });
        own.chain([column(format!("work.{name}"), "energy")]).collect::<Vec<_>>()
    };
    let of_load = |load: &Load| {
        let (measure, dimension, _) = load.kind.measure();
        let of_title = |title: &String| {
            let own = column(format!("{title}.{measure}"), dimension);
            [own, column(format!("work.{title}"), "energy")]
        };
        load.title.as_ref().map(of_title).into_iter().flatten().collect::<Vec<_>>()
    };
    let sensors = scene.sensors.iter();
    let sensors = sensors
        .map(|sensor| ExtraColumn { name: sensor.name.clone(), dimension: sensor.dimension() });
    let of_sliders = scene.sliders.iter().flat_map(of_slider);
    let of_springs = scene.springs().flat_map(of_spring);
    let of_drives = scene.drives.iter().flat_map(of_drive);
    let of_loads = scene.loads().flat_map(of_load);
    let of_wind = scene.drag_with_wind().map(|name| column(format!("work.{name}"), "energy"));
    of_sliders
        .chain(sums)
        .chain(of_springs)
        .chain(others)
        .chain(of_drives)
        .chain(of_loads)
        .chain(of_wind)
        .chain(sensors)
        .collect()
}

/// Returns true if a column contains means over the last step. These are the forces of sliders and drives, the sensors of mean values, and, for
/// some methods, the forces of springs.
pub(super) fn is_step_mean(scene: &Scene, method: Method, column: &str) -> bool {
    let is_of = |name: &str, quantity: &str| {
        column.strip_prefix(name).is_some_and(|rest| rest.strip_prefix('.') == Some(quantity))
    };
    let forces = OF_SLIDER.iter().chain([&FRICTION]).filter(|(_, dimension)| *dimension == "force");
    let mut of_slider = forces.flat_map(|(quantity, _)| {
        scene.sliders.iter().map(move |slider| (&slider.name, *quantity))
    });
    let of_drive = |drive: &Drive| {
        drive
            .motions()
            .any(|(component, _)| is_of(&drive.name, column_suffix(drive.kind, component)))
    };
    let has_mean_springs = matches!(method, Method::EnergyMomentum | Method::EnergyDecaying { .. });
    of_slider.any(|(name, quantity)| is_of(name, quantity))
        || (has_mean_springs && scene.springs().any(|spring| is_of(&spring.name, "force")))
        || scene.drives.iter().any(of_drive)
        || scene.sensors.iter().any(|sensor| sensor.is_of_step() && sensor.name == column)
}

fn column_suffix(kind: DriveKind, component: Component) -> &'static str {
    match kind {
        DriveKind::Move => component.name(),
        DriveKind::Motor => "torque",
    }
}

pub(super) fn extra_values(model: &System) -> impl Iterator<Item = f64> {
    let of_sliders = (0..model.slider_names().count()).flat_map(|slider| {
        let force = model.contact_force(slider);
        let (position, speed) = (model.slider_position(slider), model.slider_speed(slider));
        let all = [position, speed, force.norm(), force.x, force.y];
        all.into_iter().chain(model.friction_force(slider))
    });
    let sum = |of: fn(&SpringState) -> f64| model.springs().map(|spring| of(&spring)).sum::<f64>();
    let stores = model.springs().next().is_some();
    let dissipates = stores || model.dissipations().next().is_some();
    let dissipated = model
        .dissipations()
        .fold(sum(|spring| spring.dissipated), |sum, dissipated| sum + dissipated);
    let sums = [(sum(|spring| spring.stored), stores), (dissipated, dissipates)];
    let sums = sums.into_iter().filter(|(_, has)| *has).map(|(sum, _)| sum);
    let of_springs = model
        .springs()
        .flat_map(|spring| [spring.elongation, spring.force, spring.stored, spring.dissipated]);
    let of_drive = |drive: DriveState<'_>| {
        let [x, y, turned] = drive.prescribed;
        let own = [(x, drive.force.x), (y, drive.force.y), (turned, drive.moment)];
        let own = own.into_iter().filter(|(given, _)| *given).map(|(_, reaction)| reaction);
        own.chain([drive.work])
    };
    let of_drives = model.drives().flat_map(of_drive);
    let of_loads = model.named_loads().flat_map(|load| [load.value, load.work]);
    of_sliders
        .chain(sums)
        .chain(of_springs)
        .chain(model.dissipations())
        .chain(of_drives)
        .chain(of_loads)
        .chain(model.works_of_wind())
}
