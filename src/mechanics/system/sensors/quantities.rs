//! List of all quantities that can be measured.

use QuantityReader::{Acceleration, Angle, Energy, External, Force, Index, Motion, Section, Sum};
use ValueTime::{Instant, MeanOfMethod, Present, StepMean, SummedMean};

use super::SensorSource;
use crate::beams::{BodyPoint, SectionForces};
use crate::elementary::atan2;
use crate::geometry::Vec2;
use crate::system::elements::{ContactState, InternalForce, LoadAccount, RestMotion};
use crate::system::{BodyEnergy, System};

/// Quantity with its name, dimension and the function that reads it.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Name of the quantity as part of sensor names.
    pub name: &'static str,
    /// Dimension of the values of the quantity.
    pub dimension: &'static str,
    /// Time to which a value belongs.
    pub timing: ValueTime,
    pub(in crate::system) read: QuantityReader,
}

/// Time to which a value belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueTime {
    /// Present time.
    Present,
    /// Present time. The equations of motion are solved at this time for accelerations and forces.
    Instant,
    /// Mean over the last step.
    StepMean,
    /// Mean over the last step, or value at the end of the last step, depending on the method of integration.
    MeanOfMethod,
    /// Mean over the last step, which the model accumulates on request.
    SummedMean,
}

#[derive(Debug, Clone, Copy)]
pub(in crate::system) enum QuantityReader {
    Motion(fn(&System, &BodyPoint) -> f64),
    Acceleration(fn(Vec2) -> f64),
    Angle,
    Section(fn(&SectionForces) -> f64),
    Energy(fn(&BodyEnergy) -> f64),
    Force(fn(Vec2, f64) -> f64),
    Index(fn(&System, usize) -> f64),
    Sum(fn(&System, SensorSource) -> Option<f64>),
    External,
}

const fn quantity(
    name: &'static str,
    dimension: &'static str,
    timing: ValueTime,
    read: QuantityReader,
) -> Quantity {
    Quantity { name, dimension, timing, read }
}

pub(in crate::system) static OF_STATIONS: [Quantity; 15] = [
    quantity("x", "length", Present, Motion(|model, at| model.position(at).x)),
    quantity("y", "length", Present, Motion(|model, at| model.position(at).y)),
    quantity("vx", "length/time", Present, Motion(|model, at| model.velocity(at).x)),
    quantity("vy", "length/time", Present, Motion(|model, at| model.velocity(at).y)),
    quantity("speed", "length/time", Present, Motion(|model, at| model.velocity(at).norm())),
    quantity("ax", "length/time²", Instant, Acceleration(|acceleration| acceleration.x)),
    quantity("ay", "length/time²", Instant, Acceleration(|acceleration| acceleration.y)),
    quantity("angle", "rad", Present, Angle),
    quantity("spin", "1/time", Present, Motion(System::spin)),
    quantity("N", "force", Present, Section(|section| section.axial)),
    quantity("Q", "force", Present, Section(|section| section.shear)),
    quantity("M", "force·length", Present, Section(|section| section.moment)),
    quantity("axial_strain", "-", Present, Section(|section| section.axial_strain)),
    quantity("shear_strain", "-", Present, Section(|section| section.shear_strain)),
    quantity("curvature", "1/length", Present, Section(|section| section.curvature)),
];

/// Number of quantities of stations that are also defined for particles: the first 7 entries of `OF_STATIONS`.
pub(in crate::system) const OF_PARTICLES: usize = 7;

/// Number of quantities of stations that are also defined for points of rigid bodies: the first 9 entries of `OF_STATIONS`.
pub(in crate::system) const OF_POINTS: usize = 9;

pub(in crate::system) static OF_BODIES: [Quantity; 7] = [
    quantity("energy", "energy", Present, Energy(BodyEnergy::total)),
    quantity("kinetic", "energy", Present, Energy(|energy| energy.kinetic)),
    quantity("strain", "energy", Present, Energy(BodyEnergy::strain)),
    quantity("axial", "energy", Present, Energy(|energy| energy.axial)),
    quantity("shear", "energy", Present, Energy(|energy| energy.shear)),
    quantity("bending", "energy", Present, Energy(|energy| energy.bending)),
    quantity("potential", "energy", Present, Energy(|energy| energy.potential)),
];

pub(in crate::system) static OF_JOINTS: [Quantity; 9] = [
    quantity("force", "force", SummedMean, Force(|force, _| force.norm())),
    quantity("fx", "force", SummedMean, Force(|force, _| force.x)),
    quantity("fy", "force", SummedMean, Force(|force, _| force.y)),
    quantity("moment", "force·length", SummedMean, Force(|_, moment| moment)),
    quantity("force_angle", "rad", SummedMean, Force(|force, _| atan2(force.y, force.x))),
    quantity("present_force", "force", Instant, Force(|force, _| force.norm())),
    quantity("present_fx", "force", Instant, Force(|force, _| force.x)),
    quantity("present_fy", "force", Instant, Force(|force, _| force.y)),
    quantity("present_moment", "force·length", Instant, Force(|_, moment| moment)),
];

pub(in crate::system) static COLUMNS_OF_SLIDERS: [Quantity; 5] = [
    quantity("position", "-", Present, Index(System::slider_position)),
    quantity("speed", "length/time", Present, Index(System::slider_speed)),
    quantity("force", "force", StepMean, Index(|model, at| model.contact_force(at).norm())),
    quantity("force_x", "force", StepMean, Index(|model, at| model.contact_force(at).x)),
    quantity("force_y", "force", StepMean, Index(|model, at| model.contact_force(at).y)),
];

pub(in crate::system) static SLEEVE_COUPLE: Quantity =
    quantity("couple", "force·length", StepMean, Index(System::sleeve_couple));

pub(in crate::system) static SLIDER_FRICTION: Quantity =
    quantity("friction", "force", StepMean, Index(friction));

pub(in crate::system) static FLIGHT_GAP: Quantity =
    quantity("gap", "length", Present, Index(flight_gap));

pub(in crate::system) static OF_SLIDERS: [Quantity; 5] = [
    quantity("present_force", "force", Instant, Force(|force, _| force.norm())),
    quantity("present_force_x", "force", Instant, Force(|force, _| force.x)),
    quantity("present_force_y", "force", Instant, Force(|force, _| force.y)),
    quantity("present_couple", "force·length", Instant, Force(|_, moment| moment)),
    quantity("arc_length", "length", Present, Index(System::slider_arc_length)),
];

/// Columns of drives: the force or moment of each prescribed component.
pub(in crate::system) static COLUMNS_OF_MOVES: [Quantity; 3] = [
    quantity("x", "force", StepMean, Index(|model, at| model.drive(at).force.x)),
    quantity("y", "force", StepMean, Index(|model, at| model.drive(at).force.y)),
    quantity("angle", "force·length", StepMean, Index(|model, at| model.drive(at).moment)),
];

pub(in crate::system) static TORQUE: Quantity = Quantity { name: "torque", ..COLUMNS_OF_MOVES[2] };

pub(in crate::system) static COLUMNS_OF_SPRINGS: [Quantity; 2] = [
    quantity("length", "length", Present, Index(|model, at| spring(model, at)[0])),
    quantity("force", "force", MeanOfMethod, Index(|model, at| spring(model, at)[1])),
];

pub(in crate::system) static COLUMNS_OF_TORSION_SPRINGS: [Quantity; 2] = [
    Quantity { name: "angle", dimension: "rad", ..COLUMNS_OF_SPRINGS[0] },
    Quantity { dimension: "force·length", ..COLUMNS_OF_SPRINGS[1] },
];

pub(in crate::system) static REST_LENGTH: Quantity =
    quantity("rest_length", "length", Present, Index(rest_value));

pub(in crate::system) static REST_ANGLE: Quantity =
    Quantity { name: "rest_angle", dimension: "rad", ..REST_LENGTH };

pub(in crate::system) static COLUMNS_OF_OBSTACLES: [Quantity; 4] = [
    quantity("force", "force", MeanOfMethod, Index(|model, at| contact(model, at).force.norm())),
    quantity("force_x", "force", MeanOfMethod, Index(|model, at| contact(model, at).force.x)),
    quantity("force_y", "force", MeanOfMethod, Index(|model, at| contact(model, at).force.y)),
    quantity("gap", "length", Present, Index(contact_gap)),
];

pub(in crate::system) static OBSTACLE_FRICTION: Quantity =
    quantity("friction", "force", MeanOfMethod, Index(|model, at| contact(model, at).friction));

pub(in crate::system) static COLUMNS_OF_LOADS: [Quantity; 3] = [
    quantity("force", "force", Present, Index(|model, at| load(model, at).value)),
    quantity("force", "force/length", Present, Index(|model, at| load(model, at).value)),
    quantity("torque", "force·length", Present, Index(|model, at| load(model, at).value)),
];

pub(in crate::system) static STORED: Quantity = quantity("stored", "energy", Present, Sum(stored));

/// Energy dissipated by dampers, brakes, damped materials, drag, contacts and sliders since the start.
pub(in crate::system) static DISSIPATED: Quantity =
    quantity("dissipated", "energy", Present, Sum(dissipated));

pub(in crate::system) static WORK: Quantity = quantity("work", "energy", Present, Sum(work));

/// Power of a drive, a named load or a spring with a prescribed rest length: its work in the last step, divided by the duration of the step.
pub(in crate::system) static POWER: [Quantity; 1] =
    [quantity("power", "energy/time", SummedMean, Sum(power))];

/// Quantities that are recorded on request, with their types of objects.
pub static RECORDABLE: [(&str, &[Quantity]); 5] = [
    ("stations", &OF_STATIONS),
    ("bodies", &OF_BODIES),
    ("joints", &OF_JOINTS),
    ("sliders", &OF_SLIDERS),
    ("drives, named loads and springs with a prescribed length", &POWER),
];

pub(in crate::system) static OF_CALLER: Quantity = quantity("", "-", Present, External);

fn friction(model: &System, slider: usize) -> f64 {
    model.friction_force(slider).unwrap_or(f64::NAN)
}

fn flight_gap(model: &System, slider: usize) -> f64 {
    model.flight_gap(slider).unwrap_or(f64::NAN)
}

fn internal_force(model: &System, at: usize) -> &dyn InternalForce {
    model.elements().internal_force(at)
}

fn spring(model: &System, at: usize) -> [f64; 2] {
    let state = internal_force(model, at).stretched();
    state.map_or([f64::NAN; 2], |state| [state.elongation, state.force])
}

fn rest_value(model: &System, at: usize) -> f64 {
    internal_force(model, at).rest_motion().map_or(f64::NAN, RestMotion::value)
}

fn contact(model: &System, at: usize) -> ContactState {
    internal_force(model, at).contact().unwrap_or_default()
}

fn contact_gap(model: &System, at: usize) -> f64 {
    internal_force(model, at).smallest_gap(model.bodies()).unwrap_or(f64::NAN)
}

fn load(model: &System, at: usize) -> LoadAccount {
    model.elements().external_force(at).account().unwrap_or_default()
}

fn stored(model: &System, source: SensorSource) -> Option<f64> {
    match source {
        SensorSource::Scene => Some(model.elements().stored()),
        SensorSource::InternalForce(at) => Some(internal_force(model, at).stored()),
        _ => None,
    }
}

fn dissipated(model: &System, source: SensorSource) -> Option<f64> {
    match source {
        SensorSource::Scene => {
            let by_springs = model.springs().map(|spring| spring.dissipated).sum::<f64>();
            Some(model.dissipations().fold(by_springs, |sum, dissipated| sum + dissipated))
        }
        SensorSource::InternalForce(at) => Some(internal_force(model, at).dissipated()),
        SensorSource::Slider(at) => Some(model.slider(at).lost_energy),
        _ => None,
    }
}

fn work(model: &System, source: SensorSource) -> Option<f64> {
    match source {
        SensorSource::Drive(at) => Some(model.drive(at).work),
        SensorSource::Load(at) => Some(load(model, at).work),
        SensorSource::InternalForce(at) => internal_force(model, at).external_work(),
        _ => None,
    }
}

fn power(model: &System, source: SensorSource) -> Option<f64> {
    match source {
        SensorSource::Drive(at) => model.power_of_drive(at),
        SensorSource::Load(at) => model.power_of_load(at),
        SensorSource::InternalForce(at) => model.power_of_internal_force(at),
        _ => None,
    }
}

/// Section forces and strains of a section with their names.
pub fn section_values(section: &SectionForces) -> impl Iterator<Item = (&'static str, f64)> {
    OF_STATIONS.iter().filter_map(move |quantity| match quantity.read {
        Section(read) => Some((quantity.name, read(section))),
        _ => None,
    })
}

/// Energies of a body with their names.
pub fn body_energies(energy: &BodyEnergy) -> impl Iterator<Item = (&'static str, f64)> {
    OF_BODIES.iter().filter_map(move |quantity| match quantity.read {
        Energy(read) => Some((quantity.name, read(energy))),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantity_names_are_unique_in_each_list() {
        let of_sliders = [&COLUMNS_OF_SLIDERS[..], &OF_SLIDERS].concat();
        for (object, list) in RECORDABLE.into_iter().chain([("sliders", &of_sliders[..])]) {
            let names: Vec<&str> = list.iter().map(|quantity| quantity.name).collect();
            for (at, name) in names.iter().enumerate() {
                assert!(!name.is_empty() && !names[..at].contains(name), "{name} of {object}");
            }
        }
    }

    #[test]
    fn quantities_of_particles_and_points_need_no_section() {
        let needs_section = |quantity: &Quantity| matches!(quantity.read, Section(_));
        assert!(!OF_STATIONS[..OF_POINTS].iter().any(needs_section));
        assert_eq!((OF_STATIONS[OF_PARTICLES].name, OF_STATIONS[OF_POINTS].name), ("angle", "N"));
    }

    #[test]
    fn magnitude_and_angle_of_a_force_reproduce_its_components() {
        let read = |name: &str, force: Vec2| {
            let quantity = OF_JOINTS.iter().find(|quantity| quantity.name == name);
            match quantity.map(|quantity| quantity.read) {
                Some(Force(read)) => read(force, 0.0),
                other => panic!("{name}: {other:?}"),
            }
        };
        for force in [Vec2::new(3.0, -4.0), Vec2::new(-1.0, 0.0), Vec2::zeros()] {
            let (size, angle) = (read("force", force), read("force_angle", force));
            let again = Vec2::new(size * angle.cos(), size * angle.sin());
            assert!((again - force).norm() < 1e-15 * (1.0 + size), "{force}");
            assert_eq!([read("fx", force), read("fy", force)], [force.x, force.y]);
        }
    }
}
