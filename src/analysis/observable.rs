//! Quantities of a run that are compared with reference values.

use serde::{Deserialize, Serialize};

use crate::beams::Station;
use crate::geometry::Vec2;
use crate::simulation::{History, Simulation};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Observable {
    pub name: String,
    pub kind: ObservableKind,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum ObservableKind {
    /// Position of a station [length].
    Position(Station),
    /// Angle of the section at a station [rad].
    Angle(Station),
    Column {
        column: String,
        factor: f64,
    },
}

pub const SYMBOLS: [(&str, &str); 6] = [
    ("E", "energy"),
    ("KE", "kinetic"),
    ("SE", "strain"),
    ("px", "momentum_x"),
    ("py", "momentum_y"),
    ("Lz", "angular_momentum"),
];

pub fn is_of_the_motion(column: &str) -> bool {
    History::COLUMNS.iter().all(|own| own.name != column || own.is_of_motion)
}

impl Observable {
    pub fn of_station(name: &str, station: Station) -> impl Iterator<Item = Self> {
        let angle = station.turns().then_some(ObservableKind::Angle(station));
        let kinds = std::iter::once(ObservableKind::Position(station)).chain(angle);
        let name = name.to_owned();
        kinds.map(move |kind| Self { name: name.clone(), kind })
    }

    pub fn of_column(name: &str, column: &str, factor: f64) -> Self {
        let kind = ObservableKind::Column { column: column.to_owned(), factor };
        Self { name: name.to_owned(), kind }
    }

    pub fn of_history(history: &History) -> impl Iterator<Item = Self> {
        let columns = history.columns().filter(|(name, _)| is_of_the_motion(name));
        columns.map(|(name, _)| Self::of_column(name, name, 1.0))
    }

    pub fn is_position(&self) -> bool {
        matches!(self.kind, ObservableKind::Position(_))
    }

    pub fn describe(&self) -> String {
        match &self.kind {
            ObservableKind::Position(_) => format!("position of {}", self.name),
            ObservableKind::Angle(_) => format!("angle of {}", self.name),
            ObservableKind::Column { .. } => self.name.clone(),
        }
    }

    /// Present value of the observable: a vector, a scalar as the first component, or NaN if undefined.
    pub fn read(&self, simulation: &Simulation) -> Vec2 {
        let scalar = |value: Option<f64>| Vec2::new(value.unwrap_or(f64::NAN), 0.0);
        match &self.kind {
            ObservableKind::Position(station) => simulation.place(station).map_or_else(
                |_| Vec2::new(f64::NAN, f64::NAN),
                |place| simulation.model().position(&place),
            ),
            ObservableKind::Angle(station) => {
                scalar(simulation.model().angle(simulation.scene(), station))
            }
            ObservableKind::Column { column, factor } => {
                let values = simulation.history().column(column);
                scalar(values.and_then(|values| Some(values.last()? * factor)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::spinning;
    use super::*;

    #[test]
    fn observables_are_station_positions_angles_and_history_columns() {
        let simulation = spinning(0.1, &[1.0]).start(super::super::RunLimits::default()).unwrap();
        let tip: Vec<_> = Observable::of_station("tip", Station::on_beam(0, 2.0)).collect();
        assert_eq!(tip[0].read(&simulation), Vec2::new(2.0, 0.0));
        assert_eq!((tip[1].describe().as_str(), tip[1].read(&simulation).x), ("angle of tip", 0.0));
        assert_eq!(Observable::of_station("stone", Station::on_particle(0)).count(), 1);
        let energy = Observable::of_column("2 E", "energy", 2.0).read(&simulation);
        let measured = simulation.history().samples()[0].measures.energy.total();
        assert_eq!(energy.x, 2.0 * measured);
        assert!(Observable::of_column("S", "slider.position", 1.0).read(&simulation).x.is_nan());
        let inside = Observable::of_station("inside", Station::on_beam(0, 0.3)).last().unwrap();
        assert!(inside.read(&simulation).x.is_nan(), "its angle is not followed");
        let names: Vec<_> =
            Observable::of_history(simulation.history()).map(|of| of.name).collect();
        assert!(names.contains(&"strain".to_owned()) && !names.contains(&"retries".to_owned()));
    }

    #[test]
    fn symbols_refer_to_existing_history_columns() {
        let history = History::default();
        assert!(SYMBOLS.iter().all(|(_, column)| history.dimension(column).is_some()));
    }
}
