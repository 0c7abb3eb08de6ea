//! Values that pass between Python and the thread of a session.

use rhai::{Array, Dynamic, FLOAT, INT, Map};
use withy::geometry::Vec2;

/// Value without references to the engine, which cannot leave its thread.
#[derive(Clone, Debug)]
pub enum Value {
    Nothing,
    Boolean(bool),
    Integer(i64),
    Number(f64),
    Text(String),
    Numbers(Vec<f64>),
    Integers(Vec<i64>),
    Vector([f64; 2]),
    Vectors(Vec<[f64; 2]>),
    /// Array of maps with the same keys and numbers, by columns.
    Table(Vec<(String, Vec<f64>)>),
    Array(Vec<Value>),
    Map(Vec<(String, Value)>),
    Object(ObjectReference),
    /// Python function, by its number.
    Function(u64),
}

/// Reference to a value that stays in the thread of its session.
#[derive(Clone, Debug)]
pub struct ObjectReference {
    /// Number of the value in its session.
    pub number: u64,
    /// Name of its type in the language.
    pub type_name: String,
}

/// Storage for script values that are passed to Python by reference, and source of script functions that call Python.
pub trait Keeper {
    /// Stores a value.
    fn keep(&self, value: Dynamic) -> ObjectReference;
    /// Returns a stored value.
    fn kept(&self, reference: &ObjectReference) -> Dynamic;
    /// Creates a script function that calls the Python function of this number.
    fn function(&self, number: u64) -> Dynamic;
}

impl Value {
    /// Converts a script value. Values of native types are kept by `keeper`.
    pub fn of(value: Dynamic, keeper: &dyn Keeper) -> Self {
        let value = value.flatten();
        if value.is_unit() {
            return Self::Nothing;
        }
        if let Ok(truth) = value.as_bool() {
            return Self::Boolean(truth);
        }
        if let Ok(whole) = value.as_int() {
            return Self::Integer(whole);
        }
        if let Ok(number) = value.as_float() {
            return Self::Number(number);
        }
        if let Some(vector) = value.read_lock::<Vec2>() {
            return Self::Vector([vector.x, vector.y]);
        }
        if value.is_string() || value.is_char() {
            return Self::Text(value.to_string());
        }
        match value.try_cast_result::<Array>() {
            Ok(array) => Self::of_array(array, keeper),
            Err(value) => match value.try_cast_result::<Map>() {
                Ok(map) => Self::of_map(map, keeper),
                Err(value) => Self::Object(keeper.keep(value)),
            },
        }
    }

    fn of_map(map: Map, keeper: &dyn Keeper) -> Self {
        let entries = map.into_iter();
        Self::Map(entries.map(|(key, value)| (key.into(), Self::of(value, keeper))).collect())
    }

    fn of_array(array: Array, keeper: &dyn Keeper) -> Self {
        if array.is_empty() {
            return Self::Array(Vec::new());
        }
        if let Some(whole) = array.iter().map(|value| value.as_int().ok()).collect() {
            return Self::Integers(whole);
        }
        if let Some(numbers) = array.iter().map(number).collect() {
            return Self::Numbers(numbers);
        }
        let components = |value: &Dynamic| value.read_lock::<Vec2>().map(|of| [of.x, of.y]);
        if let Some(vectors) = array.iter().map(components).collect() {
            return Self::Vectors(vectors);
        }
        if let Some(columns) = columns(&array) {
            return Self::Table(columns);
        }
        Self::Array(array.into_iter().map(|value| Self::of(value, keeper)).collect())
    }

    /// Converts the value to a script value.
    pub fn to_dynamic(&self, keeper: &dyn Keeper) -> Dynamic {
        match self {
            Self::Nothing => Dynamic::UNIT,
            Self::Boolean(truth) => (*truth).into(),
            Self::Integer(whole) => (*whole as INT).into(),
            Self::Number(number) => (*number as FLOAT).into(),
            Self::Text(text) => text.into(),
            Self::Numbers(numbers) => array(numbers.iter().map(|x| (*x).into())),
            Self::Integers(whole) => array(whole.iter().map(|x| (*x).into())),
            Self::Vector([x, y]) => vector(*x, *y),
            Self::Vectors(all) => array(all.iter().map(|[x, y]| vector(*x, *y))),
            Self::Table(columns) => array(rows(columns)),
            Self::Array(values) => array(values.iter().map(|value| value.to_dynamic(keeper))),
            Self::Map(entries) => {
                let entries = entries.iter();
                let map: Map =
                    entries.map(|(key, value)| (key.into(), value.to_dynamic(keeper))).collect();
                map.into()
            }
            Self::Object(reference) => keeper.kept(reference),
            Self::Function(function) => keeper.function(*function),
        }
    }
}

fn array(values: impl Iterator<Item = Dynamic>) -> Dynamic {
    values.collect::<Array>().into()
}

fn vector(x: f64, y: f64) -> Dynamic {
    Dynamic::from(Vec2::new(x, y))
}

fn number(value: &Dynamic) -> Option<f64> {
    value.as_float().ok().or_else(|| value.as_int().ok().map(|whole| whole as f64))
}

/// Columns of an array of maps; `None` if the maps have different keys or other values than numbers.
fn columns(array: &Array) -> Option<Vec<(String, Vec<f64>)>> {
    let first = array.first()?.read_lock::<Map>()?;
    let mut columns: Vec<(String, Vec<f64>)> =
        first.keys().map(|key| (key.to_string(), Vec::with_capacity(array.len()))).collect();
    for row in array {
        let row = row.read_lock::<Map>()?;
        if row.len() != columns.len() {
            return None;
        }
        for (key, column) in &mut columns {
            column.push(number(row.get(key.as_str())?)?);
        }
    }
    Some(columns).filter(|columns| !columns.is_empty())
}

fn rows(columns: &[(String, Vec<f64>)]) -> impl Iterator<Item = Dynamic> {
    let count = columns.first().map_or(0, |(_, column)| column.len());
    (0..count).map(move |row| {
        let entries = columns.iter();
        let map: Map =
            entries.map(|(key, column)| (key.into(), Dynamic::from(column[row]))).collect();
        map.into()
    })
}
