//! Published results of other programs for the same problem.

use super::csv_table::{ParsedCsv, ParsedCsvError};
use super::observable::Observable;
use super::reference::{ReferenceError, ReferenceSolution};
use crate::geometry::Vec2;

#[derive(Debug, Clone, PartialEq)]
pub struct ExternalResult {
    pub program: String,
    pub series: String,
    pub setting: String,
    /// Run time [s].
    pub run_time: f64,
    /// Largest distance of a station from its reference position, as a fraction of the length scale of the study [-].
    pub error: f64,
    /// Energy drift [-]; NaN if not measured.
    pub energy_drift: f64,
    pub machine: String,
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExternalResultError {
    #[error(transparent)]
    Sheet(#[from] ParsedCsvError),
    #[error(transparent)]
    ReferenceMismatch(#[from] ReferenceError),
    #[error("its row {row} has positions at t = {measured}, but the study needs t = {}", requested.join(", "))]
    Times {
        row: usize,
        /// Simulated time to which the positions belong [time].
        measured: f64,
        requested: Vec<String>,
    },
}

const SETTING: [(&str, &str); 4] =
    [("integrator", ""), ("elements", "elements "), ("dof", "unknowns "), ("dt", "dt = ")];

impl ExternalResult {
    /// Reads runs from a table with the columns peer, series, run_time_s, t, machine, and positions such as xA and yA.
    /// The columns energy_drift, integrator, elements, dof and dt are optional.
    pub fn of_sheet(
        sheet: &ParsedCsv,
        observables: &[Observable],
        reference_solution: &ReferenceSolution,
        (times, length): (&[f64], f64),
    ) -> Result<Vec<Self>, ExternalResultError> {
        (0..sheet.len())
            .map(|row| {
                let measured = sheet.number(row, "t")?;
                if times.len() != 1 || (times[0] - measured).abs() > 1e-9 * measured.abs().max(1.0)
                {
                    let requested = times.iter().map(f64::to_string).collect();
                    return Err(ExternalResultError::Times { row: row + 1, measured, requested });
                }
                let compared = |(index, of): (usize, &Observable)| {
                    let is_compared = of.is_position() && reference_solution.knows(index);
                    if is_compared { position(sheet, row, of) } else { Ok(Vec2::zeros()) }
                };
                let found: Vec<Vec2> =
                    observables.iter().enumerate().map(compared).collect::<Result<_, _>>()?;
                let deviation = reference_solution.of_positions(observables, &vec![found]);
                let cell = |column: &str| sheet.text(row, column).map(str::to_owned);
                let described = SETTING.iter().filter_map(|(column, word)| {
                    let text = sheet.text(row, column).ok().filter(|text| !text.is_empty())?;
                    Some(format!("{word}{text}"))
                });
                Ok(Self {
                    program: cell("peer")?,
                    series: cell("series")?,
                    setting: described.collect::<Vec<_>>().join(", "),
                    run_time: sheet.number(row, "run_time_s")?,
                    error: deviation.map_or(f64::NAN, |of| of.divided_by(length).error()),
                    energy_drift: sheet.number(row, "energy_drift").unwrap_or(f64::NAN),
                    machine: cell("machine")?,
                })
            })
            .collect()
    }
}

fn position(sheet: &ParsedCsv, row: usize, of: &Observable) -> Result<Vec2, ParsedCsvError> {
    let [x, y] = ["x", "y"].map(|axis| sheet.number(row, &format!("{axis}{}", of.name)));
    Ok(Vec2::new(x?, y?))
}

pub fn machines(external_results: &[ExternalResult]) -> Vec<&str> {
    let mut machines = Vec::new();
    for external_result in
        external_results.iter().map(|external_result| external_result.machine.as_str())
    {
        if !machines.contains(&external_result) {
            machines.push(external_result);
        }
    }
    machines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::Station;

    const RIVALS: &str = "# made by hand\nseries,peer,integrator,dt,run_time_s,t,xA,yA,energy_drift,machine\n\
                          fast,P,euler,0.1,0.5,1,3,4.5,1e-3,a Cray\nslow,P,,0.2,2,1,3,4,,a Cray\n";

    #[test]
    fn results_of_other_programs_are_compared_with_the_reference() {
        let observables: Vec<_> = Observable::of_station("A", Station::on_beam(0, 0.0)).collect();
        let table = ParsedCsv::parse("t,xA,yA\n1,3,4\n2,0,0\n").unwrap();
        let reference_solution =
            ReferenceSolution::of_sheet("T", &table, &observables, &[1.0]).unwrap();
        let sheet = ParsedCsv::parse(RIVALS).unwrap();
        let external_results =
            ExternalResult::of_sheet(&sheet, &observables, &reference_solution, (&[1.0], 10.0))
                .unwrap();
        assert_eq!(external_results[0].error, 0.05);
        assert!(external_results[1].error < 1e-13, "{}", external_results[1].error);
        assert_eq!(external_results[0].setting, "euler, dt = 0.1");
        assert!(external_results[1].energy_drift.is_nan());
        assert_eq!(machines(&external_results), ["a Cray"]);
        let message =
            ExternalResult::of_sheet(&sheet, &observables, &reference_solution, (&[2.0], 10.0))
                .unwrap_err();
        assert!(message.to_string().contains("row 1 has positions at t = 1"), "{message}");
        let lame = ParsedCsv::parse("series,peer,t,xA,yA\na,b,1,0,0\n").unwrap();
        let message =
            ExternalResult::of_sheet(&lame, &observables, &reference_solution, (&[1.0], 10.0))
                .unwrap_err();
        assert!(message.to_string().contains("no column 'run_time_s'"), "{message}");
    }
}
