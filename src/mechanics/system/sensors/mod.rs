//! Sensors: the list of quantities that can be measured.
//!
//! The columns of every history and the quantities that are recorded on request are sensors.
//! The name of a sensor consists of an object, a location and a quantity: `rod.end.x`, `rod[0.5].M`, `rod.energy`, `hinge1.force`.
//! In sums of energy the quantity comes first: `work.motor1`.

pub(in crate::system) mod quantities;
mod sensor;

pub use quantities::{Quantity, RECORDABLE, ValueTime, body_energies, section_values};
pub use sensor::{Sensor, SensorSource};
