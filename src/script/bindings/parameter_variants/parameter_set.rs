//! Parameters that belong together: those of one scene. For each there is a variant of everything at the parameter plus and minus a distance.

use std::any::TypeId;
use std::cell::{Cell, RefCell};
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

use rhai::Dynamic;

use super::variant_value::VariantValue;
use crate::output::significant;
use crate::script::messages::error::{CallPart, ScriptError};

/// The distance to the variants beside, as a part of the size of a parameter. What is made of it errs by its square and by rounding over it.
pub const RELATIVE_DISTANCE: f64 = 1e-5;

/// Parameters that belong together. Variant 0 is at their values; 1 and 2 are at the first one plus and minus a distance, 3 and 4 at the second one.
#[derive(Default)]
pub struct ParameterSet {
    parameters: RefCell<Vec<DeclaredParameter>>,
    /// Whether variants are in use, so that none may be added.
    is_in_use: Cell<bool>,
    /// The places of the script, by line and column, where a function decides by a parameter.
    told: RefCell<BTreeSet<(usize, usize)>>,
}

/// A parameter of a family.
#[derive(Clone)]
struct DeclaredParameter {
    name: String,
    distance: f64,
}

/// The variant that a call is made for.
#[derive(Clone)]
pub struct CurrentVariant {
    /// The parameters.
    pub family: Rc<ParameterSet>,
    /// The variant of them.
    pub variant: usize,
}

thread_local! {
    /// Whether there has been a family in this thread.
    static ANY: Cell<bool> = const { Cell::new(false) };
    /// The names of types, and how things of a scene tell the parameters that it depends on.
    static THINGS: RefCell<HashMap<TypeId, (&'static str, SceneParameters)>> = RefCell::default();
    static PRESENT: RefCell<Option<CurrentVariant>> = const { RefCell::new(None) };
    /// Why what is asked beside is not known.
    static LOST: RefCell<Option<Rc<str>>> = const { RefCell::new(None) };
}

/// The parameters that a thing of a scene depends on, if it does.
type SceneParameters = fn(&Dynamic) -> Option<Rc<ParameterSet>>;

/// Keeps the name of a type, and how its values tell the parameters that they depend on.
pub fn know(id: TypeId, name: &'static str, family_of: SceneParameters) {
    THINGS.with_borrow_mut(|known| {
        known.insert(id, (name, family_of));
    });
}

/// The name of the type of a value, if it is one of ours.
pub(super) fn name_of(value: &Dynamic) -> Option<&'static str> {
    THINGS.with_borrow(|known| known.get(&value.type_id()).map(|(name, _)| *name))
}

/// The parameters that a thing of a scene depends on, if the value is one and does.
pub(super) fn of_thing(value: &Dynamic) -> Option<Rc<ParameterSet>> {
    let known = THINGS.with_borrow(|known| known.get(&value.type_id()).copied());
    known.and_then(|(_, family_of)| family_of(value))
}

/// The variant that the present call is made for; none where it is made once.
pub fn present() -> Option<CurrentVariant> {
    PRESENT.with_borrow(Clone::clone)
}

/// The number of the variant that the present call is made for; the first where it is made once.
pub fn present_variant() -> usize {
    present().map_or(0, |present| present.variant)
}

/// What is asked beside is not known: why.
pub fn lose(reason: &str) {
    LOST.set(Some(reason.into()));
}

/// Why what was asked beside since the last time is not known, if so.
pub(super) fn take_lost() -> Option<Rc<str>> {
    LOST.take()
}

/// Calls are made for a variant as long as this lives.
pub(super) struct VariantGuard;

impl VariantGuard {
    pub(super) fn of(family: &Rc<ParameterSet>, variant: usize) -> Self {
        PRESENT.set(Some(CurrentVariant { family: Rc::clone(family), variant }));
        Self
    }
}

impl Drop for VariantGuard {
    fn drop(&mut self) {
        PRESENT.set(None);
    }
}

impl ParameterSet {
    /// A family without parameters yet.
    pub fn new() -> Rc<Self> {
        ANY.set(true);
        Rc::default()
    }

    /// Whether there may be values that depend on a parameter: without any, calls are made as they are.
    pub fn is_any() -> bool {
        ANY.get()
    }

    /// Adds a parameter with its value, and variants at a distance, or at the usual one; gives the number that depends on it.
    ///
    /// # Errors
    /// When there is one of that name, or variants of the others are in use.
    pub fn declare(
        self: &Rc<Self>,
        name: &str,
        value: f64,
        distance: Option<f64>,
    ) -> Result<VariantValue, ScriptError> {
        if self.number_of(name).is_some() {
            let told = format!("there is a parameter '{name}' already");
            let hint = "keep the number that scene.parameter gives in a variable and use that, or take another name";
            return Err(ScriptError::new(told).hint(hint).at(CallPart::Argument(0)));
        }
        if self.is_in_use.get() {
            let told = format!("parameter '{name}' comes after others of its scene are in use");
            let hint = "declare all parameters of a scene first";
            return Err(ScriptError::new(told).hint(hint).at(CallPart::Argument(0)));
        }
        let size = if value == 0.0 { 1.0 } else { value.abs() };
        let distance = distance.unwrap_or(RELATIVE_DISTANCE * size);
        // What is so near can be told apart exactly.
        let distance = 0.5 * ((value + distance) - (value - distance));
        let mut values = vec![Dynamic::from(value); self.variants()];
        values.extend([value + distance, value - distance].map(Dynamic::from));
        self.parameters.borrow_mut().push(DeclaredParameter { name: name.to_owned(), distance });
        Ok(VariantValue::new(self, values, None))
    }

    /// Whether nothing was told of a place of the script so far; now something is.
    pub fn is_told_first(&self, line: usize, column: usize) -> bool {
        self.told.borrow_mut().insert((line, column))
    }

    /// Whether a function of the scene decides by a parameter, so that derivatives are wrong where it jumps.
    pub fn is_decided_by(&self) -> bool {
        !self.told.borrow().is_empty()
    }

    /// No parameter is added any more.
    pub fn use_variants(&self) {
        self.is_in_use.set(true);
    }

    /// The number of variants.
    pub fn variants(&self) -> usize {
        1 + 2 * self.parameters.borrow().len()
    }

    /// The names of the parameters, with the distances of their variants.
    pub fn parameters(&self) -> Vec<(String, f64)> {
        let parameters = self.parameters.borrow();
        parameters.iter().map(|of| (of.name.clone(), of.distance)).collect()
    }

    /// The distance of the variants of a parameter, by its number.
    pub fn distance(&self, parameter: usize) -> Option<f64> {
        self.parameters.borrow().get(parameter).map(|of| of.distance)
    }

    /// The number of a parameter by its name, from 0.
    pub fn number_of(&self, name: &str) -> Option<usize> {
        self.parameters.borrow().iter().position(|of| of.name == name)
    }

    /// The parameter that a variant beside is about, by its number, and whether it is the one at plus the distance.
    pub fn beside(variant: usize) -> Option<(usize, bool)> {
        let beside = variant.checked_sub(1)?;
        Some((beside / 2, beside % 2 == 0))
    }

    /// What a variant is at, in words: `EI = … + 1e-3`; empty for the one at the values.
    pub fn describe(&self, variant: usize) -> String {
        let parameters = self.parameters.borrow();
        let of = Self::beside(variant).and_then(|(at, plus)| Some((parameters.get(at)?, plus)));
        of.map_or_else(String::new, |(of, plus)| {
            let distance = significant(of.distance, 3);
            format!("'{}' {} {distance}", of.name, if plus { "plus" } else { "minus" })
        })
    }
}
