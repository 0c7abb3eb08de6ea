//! Comparison of the fastest combinations with other programs.

use super::labels;
use super::precision_rows::with;
use crate::analysis::{Precision, machines};
use crate::output::{Cell, TextTable, format_number, scientific};

pub fn comparison(study: &Precision, errors: &[f64]) -> String {
    let heads = [
        "error ≤",
        "ours [ms]",
        "error",
        "drift E",
        "with",
        "other program",
        "[ms]",
        "error",
        "drift E",
        "with",
        "times slower",
    ];
    let mut table =
        TextTable::new(if study.external_results.is_empty() { &heads[..5] } else { &heads });
    let none = || labels::number("-".to_owned());
    let number = |text: String| labels::number(text);
    let pairs = errors.iter().flat_map(|error| {
        programs_with_error(study, *error).into_iter().map(move |of| (error, of))
    });
    for (error, peer) in pairs {
        let ours = study.cheapest(*error);
        let external_result = peer.and_then(|peer| study.cheapest_of(peer, *error));
        let mut cells = vec![number(format_number(*error))];
        cells.extend(match ours {
            Some(row) => [
                number(labels::milliseconds(row.cost_and_error().0)),
                number(labels::deviation(row.error)),
                number(labels::drift(row.result.free_energy_drift)),
                Cell::Text(with(row)),
            ],
            None => [none(), none(), none(), Cell::Text("no combination".to_owned())],
        });
        if let Some(peer) = peer {
            cells.push(Cell::Text(peer.to_owned()));
            cells.extend(match external_result {
                Some(external_result) => [
                    number(labels::milliseconds(external_result.run_time)),
                    number(scientific(external_result.error, 2)),
                    number(labels::drift(external_result.energy_drift)),
                    Cell::Text(format!("{}, {}", external_result.series, external_result.setting)),
                ],
                None => [none(), none(), none(), Cell::Text("no run".to_owned())],
            });
            let ratio = ours
                .zip(external_result)
                .map(|(row, external_result)| external_result.run_time / row.cost_and_error().0);
            cells.push(ratio.map_or_else(none, |ratio| number(format!("{ratio:.1}"))));
        }
        table.row(cells);
    }
    let machines = machines(&study.external_results);
    let measured = match machines.as_slice() {
        [] => String::new(),
        machines => format!("\nother programs measured on {}", machines.join("; ")),
    };
    let confirmed: String = errors.iter().filter_map(|error| confirmation(study, *error)).collect();
    format!("{}{measured}{confirmed}", table.to_string().trim_end())
}

/// Note on the fastest combination whose error is also met with smaller steps on the same mesh.
/// The result is `None` if this combination is the fastest of all, or if no combination has an error of at most `error`.
fn confirmation(study: &Precision, error: f64) -> Option<String> {
    let fastest = study.cheapest(error)?;
    let message = match study.cheapest_confirmed(error) {
        Some(row) if row == fastest => return None,
        Some(row) => format!("{} ms, {}", labels::milliseconds(row.cost_and_error().0), with(row)),
        None => "none".to_owned(),
    };
    let error = format_number(error);
    Some(format!("\n{error} also at all smaller steps of the mesh, confirmed: {message}"))
}

/// Other programs that have a run with an error of at most `error`, or only the first program if there are none.
fn programs_with_error(study: &Precision, error: f64) -> Vec<Option<&str>> {
    let peers = study.program_names();
    let able = peers.iter().copied().filter(|peer| study.cheapest_of(peer, error).is_some());
    match able.map(Some).collect::<Vec<_>>() {
        able if able.is_empty() => vec![peers.first().copied()],
        able => able,
    }
}
