//! Reference solutions of `scripts/studies/reference`. The header lines of the files describe them.

use std::path::Path;

use super::{at, ends};
use withy::geometry::Vec2;
use withy::simulation::Simulation;

pub struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

pub fn text(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/studies/reference").join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Number in a JSON file. Numbers from 30-digit arithmetic are stored as strings.
pub fn number(value: &serde_json::Value) -> f64 {
    let text = || value.as_str().and_then(|text| text.parse().ok());
    value.as_f64().or_else(text).unwrap_or_else(|| panic!("{value} is not a number"))
}

impl Table {
    pub fn read(file: &str) -> Self {
        let text = text(file);
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let columns = lines.next().unwrap().split(',').map(str::to_owned).collect();
        let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect();
        Self { columns, rows: lines.map(row).collect() }
    }

    pub fn at(&self, time: f64, column: &str) -> f64 {
        let row = self.rows.iter().find(|row| (row[0] - time).abs() < 1e-9).unwrap();
        row[self.columns.iter().position(|name| name == column).unwrap()]
    }

    /// Times of the rows up to `end`, without the first row.
    pub fn times(&self, end: f64) -> Vec<f64> {
        let times = self.rows[1..].iter().map(|row| row[0]);
        times.take_while(|time| *time < end + 1e-9).collect()
    }

    pub fn ends(&self, time: f64) -> [Vec2; 2] {
        let point = |x: &str, y: &str| at(self.at(time, x), self.at(time, y));
        [point("x0", "y0"), point("xL", "yL")]
    }

    /// Larger one of the position errors of both ends of a beam.
    pub fn error(&self, simulation: &Simulation) -> f64 {
        distance(&ends(simulation), &self.ends(simulation.time()))
    }
}

pub fn distance(a: &[Vec2; 2], b: &[Vec2; 2]) -> f64 {
    (a[0] - b[0]).norm().max((a[1] - b[1]).norm())
}
