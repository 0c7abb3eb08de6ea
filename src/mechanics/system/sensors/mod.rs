//! Sensors: measured quantities of the objects of a scene.
//!
//! The columns of every history and the quantities that are recorded on request are sensors.
//! The name of a sensor consists of an object, a location and a quantity: `rod.end.x`, `rod[0.5].M`, `rod.energy`, `hinge1.force`.
//! In the names of works, the quantity precedes the object: `work.motor1`.

pub(in crate::system) mod quantities;
mod sensor;

pub use quantities::{Quantity, RECORDABLE, ValueTime, body_energies, section_values};
pub use sensor::{Sensor, SensorSource};
