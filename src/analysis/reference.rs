//! Reference values of the observables of a study, and deviations of results from the reference values.

use super::csv_table::{ParsedCsv, ParsedCsvError};
use super::observable::{Observable, ObservableKind};
use crate::elementary::hypot;
use crate::geometry::{Vec2, larger};

pub type Readings = Vec<Vec<Vec2>>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    pub distance: f64,
    /// Estimated error of the reference value, in the unit of the observable; zero if unknown.
    pub estimated_error: f64,
    /// True if the reference was computed by this program. Its errors may then be partly equal to those of the compared run.
    /// Therefore the sum of the distance and the estimated error of the reference is reported as an upper bound of the error.
    pub is_of_own_run: bool,
}

impl Deviation {
    pub fn is_resolved(&self) -> bool {
        self.distance > self.estimated_error
    }

    pub fn error(&self) -> f64 {
        match self.is_of_own_run || !self.is_resolved() {
            true => self.distance + self.estimated_error,
            false => self.distance,
        }
    }

    /// Larger of two deviations, with the larger of their estimated errors of the reference. NaN counts as larger than any number.
    pub fn larger_deviation(self, other: Self) -> Self {
        if larger(self.distance, other.distance) == self.distance || self.distance.is_nan() {
            Self { estimated_error: self.estimated_error.max(other.estimated_error), ..self }
        } else {
            Self { estimated_error: self.estimated_error.max(other.estimated_error), ..other }
        }
    }

    pub fn divided_by(self, scale: f64) -> Self {
        Self {
            distance: self.distance / scale,
            estimated_error: self.estimated_error / scale,
            ..self
        }
    }
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    #[error(transparent)]
    Sheet(#[from] ParsedCsvError),
    #[error("it has no rows")]
    Empty,
    #[error("it has no row at t = {time}; the nearest rows are at t = {}", nearest.join(" and "))]
    Time {
        /// Requested time for which there is no reference value [time].
        time: f64,
        nearest: Vec<String>,
    },
    #[error("lines {first} and {second} are both for t = {time}, but have different values")]
    DuplicateTime {
        /// Time that occurs twice in the table [time].
        time: f64,
        first: u64,
        second: u64,
    },
    #[error(
        "it has no station of the study: the station '{station}' needs the columns x{station} and y{station}, but its columns are {known}"
    )]
    Stations { station: String, known: String },
}

const ROUNDING: f64 = 1e-13;

#[derive(Debug, Clone, Copy, PartialEq)]
struct KnownValue {
    value: Vec2,
    estimated_error: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceSolution {
    pub source: String,
    pub is_own: bool,
    known: Vec<Vec<Option<KnownValue>>>,
}

/// Largest difference of two times that count as equal, relative for times above 1 and absolute otherwise.
const SAME_TIME: f64 = 1e-9;

fn row_at(sheet: &ParsedCsv, time: f64) -> Result<usize, ReferenceError> {
    let times: Vec<f64> =
        (0..sheet.len()).map(|row| sheet.number(row, "t")).collect::<Result<_, _>>()?;
    let near = |other: f64| (other - time).abs() <= SAME_TIME * time.abs().max(1.0);
    let nearest = || {
        let before = times.iter().copied().filter(|other| *other < time).reduce(f64::max);
        let behind = times.iter().copied().filter(|other| *other > time).reduce(f64::min);
        before.into_iter().chain(behind).map(|time| time.to_string()).collect()
    };
    let mut found = (0..times.len()).filter(|row| near(times[*row]));
    let Some(first) = found.next() else {
        return Err(match sheet.is_empty() {
            true => ReferenceError::Empty,
            false => ReferenceError::Time { time, nearest: nearest() },
        });
    };
    match found.find(|other| sheet.texts(*other) != sheet.texts(first)) {
        Some(other) => {
            let (first, second) = (sheet.line(first), sheet.line(other));
            Err(ReferenceError::DuplicateTime { time, first, second })
        }
        None => Ok(first),
    }
}

fn estimate(sheet: &ParsedCsv, row: usize, columns: &[String]) -> Result<f64, ParsedCsvError> {
    let found = columns.iter().find(|column| sheet.has(column));
    found.map_or(Ok(0.0), |column| sheet.size(row, column))
}

fn known_of(
    sheet: &ParsedCsv,
    row: usize,
    of: &Observable,
) -> Result<Option<KnownValue>, ParsedCsvError> {
    let name = &of.name;
    let number = |column: &str| sheet.number(row, column);
    let either = |columns: &[String]| estimate(sheet, row, columns);
    Ok(match &of.kind {
        ObservableKind::Position(_) => {
            let [x, y] = ["x", "y"].map(|axis| format!("{axis}{name}"));
            if !sheet.has(&x) || !sheet.has(&y) {
                return Ok(None);
            }
            let groups = [format!("d_{name}"), "d_pos".to_owned()];
            let trusted = match [&x, &y].map(|column| format!("d_{column}")) {
                [x, y] if sheet.has(&x) && sheet.has(&y) => {
                    hypot(sheet.size(row, &x)?, sheet.size(row, &y)?)
                }
                _ => either(&groups)?,
            };
            Some(KnownValue {
                value: Vec2::new(number(&x)?, number(&y)?),
                estimated_error: trusted,
            })
        }
        ObservableKind::Angle(_) => {
            let column = format!("th{name}");
            if !sheet.has(&column) {
                return Ok(None);
            }
            let trusted = either(&[format!("d_{column}"), "d_th".to_owned()])?;
            Some(KnownValue { value: Vec2::new(number(&column)?, 0.0), estimated_error: trusted })
        }
        ObservableKind::Column { .. } if !sheet.has(name) => None,
        ObservableKind::Column { .. } => {
            let groups: &[&str] = match name.as_str() {
                "KE" | "SE" => &["d_KE", "d_E"],
                _ => &[],
            };
            let own = std::iter::once(format!("d_{name}"));
            let columns: Vec<String> =
                own.chain(groups.iter().map(|group| (*group).to_owned())).collect();
            Some(KnownValue {
                value: Vec2::new(number(name)?, 0.0),
                estimated_error: either(&columns)?,
            })
        }
    })
}

impl ReferenceSolution {
    /// Reads a reference from a table with the column t and, for a station A, the columns xA, yA and thA.
    /// Further columns are named like observables; columns such as d_xA, d_A, d_pos, d_thA, d_th and d_E contain estimated errors.
    pub fn of_sheet(
        source: impl Into<String>,
        sheet: &ParsedCsv,
        observables: &[Observable],
        times: &[f64],
    ) -> Result<Self, ReferenceError> {
        let at = |time: &f64| -> Result<Vec<Option<KnownValue>>, ReferenceError> {
            let row = row_at(sheet, *time)?;
            Ok(observables.iter().map(|of| known_of(sheet, row, of)).collect::<Result<_, _>>()?)
        };
        let known: Vec<_> = times.iter().map(at).collect::<Result<_, _>>()?;
        let reference_solution = Self { source: source.into(), is_own: false, known };
        let mut positions = observables.iter().enumerate().filter(|(_, of)| of.is_position());
        match positions.clone().next() {
            Some((_, first)) if !positions.any(|(index, _)| reference_solution.knows(index)) => {
                Err(ReferenceError::Stations {
                    station: first.name.clone(),
                    known: sheet.columns().join(", "),
                })
            }
            _ => Ok(reference_solution),
        }
    }

    pub fn of_run(source: impl Into<String>, readings: &Readings) -> Self {
        let known = |value: &Vec2| {
            (value.x.is_finite() && value.y.is_finite())
                .then_some(KnownValue { value: *value, estimated_error: 0.0 })
        };
        let known = readings.iter().map(|at| at.iter().map(known).collect()).collect();
        Self { source: source.into(), is_own: true, known }
    }

    pub fn with_errors_from(mut self, coarser: &Readings) -> Self {
        for (known, other) in self.known.iter_mut().zip(coarser) {
            for (known, other) in known.iter_mut().zip(other) {
                *known = known.map(|known| KnownValue {
                    estimated_error: (*other - known.value).norm(),
                    ..known
                });
            }
        }
        self
    }

    pub fn knows(&self, observable: usize) -> bool {
        self.known.iter().any(|at| at.get(observable).is_some_and(Option::is_some))
    }

    /// Largest deviation of an observable over all times of the study; `None` if the reference lacks the observable.
    pub fn deviation(&self, observable: usize, readings: &Readings) -> Option<Deviation> {
        let values = self.known.iter().filter_map(|at| (*at.get(observable)?)?.value.norm().into());
        let rounding = ROUNDING * values.fold(0.0, f64::max);
        let at = |(known, found): (&Vec<Option<KnownValue>>, &Vec<Vec2>)| {
            let known = (*known.get(observable)?)?;
            let distance = (found.get(observable)? - known.value).norm();
            let (trusted, is_of_own_run) = (known.estimated_error.max(rounding), self.is_own);
            Some(Deviation { distance, estimated_error: trusted, is_of_own_run })
        };
        self.known.iter().zip(readings).filter_map(at).reduce(Deviation::larger_deviation)
    }

    /// Largest deviation of all positions [length].
    pub fn of_positions(
        &self,
        observables: &[Observable],
        readings: &Readings,
    ) -> Option<Deviation> {
        let positions = observables.iter().enumerate().filter(|(_, of)| of.is_position());
        positions
            .filter_map(|(index, _)| self.deviation(index, readings))
            .reduce(Deviation::larger_deviation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::Station;

    const TABLE: &str = "t,xA,yA,thA,KE,d_pos,d_E\n0,0,0,0,1,0,0\n0.5,3,4,0.2,2,1e-3,0.1\n";

    fn observables() -> Vec<Observable> {
        let columns = [("KE", "kinetic"), ("SE", "strain")];
        let columns = columns.map(|(name, column)| Observable::of_column(name, column, 1.0));
        Observable::of_station("A", Station::on_beam(0, 0.0)).chain(columns).collect()
    }

    #[test]
    fn reference_table_gives_values_and_their_estimated_errors() {
        let sheet = ParsedCsv::parse(TABLE).unwrap();
        let reference_solution =
            ReferenceSolution::of_sheet("T.csv", &sheet, &observables(), &[0.5]).unwrap();
        let found = |x| vec![vec![Vec2::new(3.0, 4.0 + x), Vec2::zeros(), Vec2::new(2.0, 0.0)]];
        let near = reference_solution.of_positions(&observables(), &found(5e-4)).unwrap();
        assert!(!near.is_resolved() && (near.error() - 1.5e-3).abs() < 1e-12, "{near:?}");
        let far = reference_solution.deviation(0, &found(0.1)).unwrap().divided_by(2.0);
        assert!(far.is_resolved() && (far.error() - 0.05).abs() < 1e-12);
        assert_eq!(reference_solution.deviation(1, &found(0.0)).unwrap().error(), 0.2);
        assert_eq!(reference_solution.deviation(2, &found(0.0)).unwrap().estimated_error, 0.1);
        assert!(
            !reference_solution.knows(3) && reference_solution.deviation(3, &found(0.0)).is_none()
        );
    }

    #[test]
    fn reference_table_without_required_times_or_stations_is_rejected() {
        let sheet = ParsedCsv::parse(TABLE).unwrap();
        let outcome =
            ReferenceSolution::of_sheet("T.csv", &sheet, &observables(), &[0.3]).unwrap_err();
        assert_eq!(
            outcome.to_string(),
            "it has no row at t = 0.3; the nearest rows are at t = 0 and 0.5"
        );
        let empty = ParsedCsv::parse("t,xA,yA\n").unwrap();
        let outcome =
            ReferenceSolution::of_sheet("T.csv", &empty, &observables(), &[0.3]).unwrap_err();
        assert_eq!(outcome.to_string(), "it has no rows");
        let other: Vec<_> = Observable::of_station("tip", Station::on_beam(0, 0.0)).collect();
        let outcome =
            ReferenceSolution::of_sheet("T.csv", &sheet, &other, &[0.5]).unwrap_err().to_string();
        assert!(outcome.contains("xtip and ytip") && outcome.contains("t, xA, yA"), "{outcome}");
    }

    #[test]
    fn reference_table_with_contradictory_rows_or_negative_errors_is_rejected() {
        let outcome = |rows: &str| {
            let sheet = ParsedCsv::parse(&format!("# two\nt,xA,yA,thA,KE,d_pos\n{rows}")).unwrap();
            ReferenceSolution::of_sheet("T.csv", &sheet, &observables(), &[0.5])
                .map_err(|it| it.to_string())
        };
        let row = "0.5,3,4,0.2,2,0\n";
        assert!(outcome(&row.repeat(2)).is_ok(), "said twice is said once");
        let both = outcome(&format!("0,0,0,0,0,0\n{row}0.5,3,4.1,0.2,2,0\n")).unwrap_err();
        assert_eq!(both, "lines 4 and 5 are both for t = 0.5, but have different values");
        let negative = outcome("0.5,3,4,0.2,2,-0.1\n").unwrap_err();
        assert_eq!(
            negative,
            "line 3, column 'd_pos', holds '-0.1', but an error must not be negative"
        );
    }

    #[test]
    fn reference_run_has_the_error_estimated_from_a_coarser_run() {
        let readings = |x: f64, angle: f64| vec![vec![Vec2::new(x, 0.0), Vec2::new(angle, 0.0)]];
        let own = ReferenceSolution::of_run("own", &readings(1.0, 0.5))
            .with_errors_from(&readings(1.0, 0.51));
        let deviation = |x, angle, of| own.deviation(of, &readings(x, angle)).unwrap();
        assert!(deviation(1.0 + 1e-12, 0.5, 0).is_resolved());
        assert!(!deviation(1.0 + 1e-14, 0.5, 0).is_resolved(), "rounding is no error");
        assert!(!deviation(1.0, 0.495, 1).is_resolved() && deviation(1.0, 0.48, 1).is_resolved());
        assert!((deviation(1.0, 0.495, 1).error() - 0.015).abs() < 1e-12);
        assert!((deviation(1.0, 0.48, 1).error() - 0.03).abs() < 1e-12, "all are bounds");
    }

    #[test]
    fn error_increases_with_the_distance_from_the_reference_run() {
        let readings = |x: f64| vec![vec![Vec2::new(x, 0.0)]];
        let own = ReferenceSolution::of_run("own", &readings(1.0)).with_errors_from(&readings(1.1));
        let error = |x| own.deviation(0, &readings(x)).unwrap().error();
        assert!(error(1.099) < error(1.101), "the one beyond the difference is not the better one");
    }

    #[test]
    fn nan_is_the_largest_deviation() {
        let of = |distance| Deviation { distance, estimated_error: 0.0, is_of_own_run: false };
        let deviations = [1.0, f64::NAN, 3.0].map(of);
        for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2], [0, 2, 1]] {
            let worst = order
                .map(|index| deviations[index])
                .into_iter()
                .reduce(Deviation::larger_deviation);
            assert!(worst.unwrap().error().is_nan());
        }
        let own =
            ReferenceSolution::of_run("own", &vec![vec![Vec2::new(f64::NAN, 0.0), Vec2::zeros()]]);
        assert!(!own.knows(0) && own.knows(1) && own.is_own);
    }
}
