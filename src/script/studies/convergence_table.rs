//! Text tables of the errors and orders of a convergence study.

use super::convergence::size_name;
use super::labels;
use crate::analysis::{ALL_POSITIONS, Convergence, RefinedParameter, Refinement};
use crate::output::{Cell, TextTable, significant};

pub fn table(study: &Convergence) -> String {
    let tables = study.quantities().into_iter().map(|of| table_of(study, of));
    let tables: String = tables.map(|table| format!("\n\n{table}")).collect();
    format!("{}{tables}{}", head(study), failures(study))
}

/// Report of a convergence study with the table of the errors of all positions, and only the fitted orders of the other quantities.
pub fn summary(study: &Convergence) -> String {
    let positions = table_of(study, ALL_POSITIONS);
    format!("{}\n\n{positions}{}{}", head(study), other_orders(study), failures(study))
}

pub(super) fn head(study: &Convergence) -> String {
    format!(
        "study '{}': convergence at {}, {}\nreference: {}",
        study.name,
        labels::at_times(&study.times),
        study.fixed,
        study.reference.source
    )
}

fn table_of(study: &Convergence, quantity: &str) -> String {
    let ladders: Vec<&Refinement> = study.ladders_with(quantity).collect();
    let names = ladders.iter().flat_map(|ladder| [labels::method(&ladder.method), "order".into()]);
    let heads: Vec<String> = std::iter::once(size_name(study).to_owned()).chain(names).collect();
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    let mut table = TextTable::new(&heads).title(quantity);
    for (rung, size) in ladders[0].sizes.iter().enumerate() {
        let shown = match study.refined {
            RefinedParameter::Step => significant(*size, 6),
            RefinedParameter::Mesh => format!("1/{}", significant(1.0 / size, 6)),
        };
        let cells = ladders.iter().flat_map(|ladder| {
            let error = labels::deviation(ladder.deviations[rung]);
            [error, order(ladder.order(rung))].map(Cell::Number)
        });
        table.row(std::iter::once(Cell::Number(shown)).chain(cells));
    }
    let fitted = ladders.iter().flat_map(|ladder| {
        let claimed = study.claimed_order(&ladder.method);
        let claimed = claimed.map_or_else(String::new, |order| format!("claimed {order}"));
        [claimed, order(ladder.fitted_order())].map(Cell::Number)
    });
    table.row(std::iter::once(Cell::Text("all".to_owned())).chain(fitted));
    table.to_string().trim_end().to_owned()
}

fn other_orders(study: &Convergence) -> String {
    let of = |quantity: &str| {
        let ladders = study.ladders_with(quantity);
        ladders.map(|ladder| (labels::method(&ladder.method), ladder.fitted_order())).collect()
    };
    let methods: Vec<(String, Option<f64>)> = of(ALL_POSITIONS);
    let heads: Vec<&str> =
        std::iter::once("order of").chain(methods.iter().map(|(name, _)| name.as_str())).collect();
    let mut table = TextTable::new(&heads);
    let quantities = study.quantities();
    let others: Vec<&str> = quantities.into_iter().filter(|of| *of != ALL_POSITIONS).collect();
    for quantity in &others {
        let orders = of(quantity).into_iter().map(|(_, of)| Cell::Number(order(of)));
        table.row(std::iter::once(Cell::Text((*quantity).to_owned())).chain(orders));
    }
    match others.as_slice() {
        [] => String::new(),
        _ => format!("\n\n{}", table.to_string().trim_end()),
    }
}

fn failures(study: &Convergence) -> String {
    let name = size_name(study);
    let line = |(size, method, why): &(f64, crate::integrators::Method, String)| {
        format!("\n{} with {name} = {}: {why}", labels::method(method), significant(*size, 6))
    };
    study.failures.iter().map(line).collect()
}

fn order(order: Option<f64>) -> String {
    order.map_or_else(|| "-".to_owned(), |order| format!("{order:.2}"))
}
