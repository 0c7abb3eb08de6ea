//! Measured quantity of an object.

use serde::{Serialize, Serializer};

use super::{Quantity, ValueTime};
use crate::beams::{BodyIndex, Station};
use crate::integrators::Method;

/// Measured quantity of an object.
#[derive(Debug, Clone)]
pub struct Sensor {
    /// Name of the column in histories.
    pub name: String,
    /// Object whose quantity is measured.
    pub source: SensorSource,
    /// Measured quantity.
    pub quantity: &'static Quantity,
}

/// Object of the scene that a sensor measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SensorSource {
    /// Station of a body.
    Station(Station),
    /// Whole beam, particle or rigid body.
    Body(BodyIndex),
    /// Joint of the scene.
    Joint(usize),
    /// Slider of the scene.
    Slider(usize),
    /// Drive of the scene.
    Drive(usize),
    /// Load, given by its index among the loads of the scene.
    Load(usize),
    /// Element that is neither a mass nor a load, such as a spring, damped material, drag or contact. Only such elements are counted in its index.
    InternalForce(usize),
    /// Whole scene.
    Scene,
    /// Sensor without an object of the scene. The caller of the simulation provides its value after every row.
    External,
}

impl Sensor {
    pub(in crate::system) fn of(
        object: &str,
        quantity: &'static Quantity,
        source: SensorSource,
    ) -> Self {
        Self { name: format!("{object}.{}", quantity.name), source, quantity }
    }

    pub(in crate::system) fn in_sum(
        quantity: &'static Quantity,
        object: &str,
        source: SensorSource,
    ) -> Self {
        Self { name: format!("{}.{object}", quantity.name), source, quantity }
    }

    /// Returns true if the values of the sensor are means over the last step with the given integrator.
    pub(crate) fn is_step_mean(&self, method: Method) -> bool {
        match self.quantity.timing {
            ValueTime::StepMean | ValueTime::SummedMean => true,
            ValueTime::MeanOfMethod => {
                matches!(method, Method::EnergyMomentum | Method::EnergyDecaying { .. })
            }
            ValueTime::Present | ValueTime::Instant => false,
        }
    }

    /// Returns true if the values of the sensor are means over the last step that the model accumulates on request.
    pub(crate) fn is_summed(&self) -> bool {
        self.quantity.timing == ValueTime::SummedMean
    }

    pub(crate) fn is_mean_of_joint(&self) -> bool {
        self.is_summed() && matches!(self.source, SensorSource::Joint(_))
    }

    /// Returns true if the caller provides the values of the sensor.
    pub fn is_external(&self) -> bool {
        self.source == SensorSource::External
    }

    /// Returns true if the sensor can be stored, that is, if it can be created again from its name.
    pub fn can_be_stored(&self) -> bool {
        !self.is_external()
    }
}

impl Serialize for Sensor {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.can_be_stored() {
            true => self.name.serialize(serializer),
            false => Err(serde::ser::Error::custom("a function cannot be stored")),
        }
    }
}
