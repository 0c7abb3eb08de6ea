//! Variables of a session.

use std::collections::HashSet;

use rhai::{Dynamic, ImmutableString, Scope};

/// Variables of a scope that no later variable of the same name hides; `None` if no variable is hidden.
pub fn visible(scope: &Scope<'static>) -> Option<Scope<'static>> {
    let mut names = HashSet::new();
    let seen: Vec<_> = scope.iter_raw().filter(|(name, ..)| names.insert(*name)).collect();
    if seen.len() == scope.len() {
        return None;
    }
    let mut visible = Scope::new();
    for (name, is_constant, value) in seen.into_iter().rev() {
        match is_constant {
            true => visible.push_constant_dynamic(name, value.clone()),
            false => visible.push_dynamic(name, value.clone()),
        };
    }
    Some(visible)
}

pub fn constants_after(
    scope: &Scope,
    known: usize,
) -> impl Iterator<Item = (ImmutableString, Dynamic)> {
    let new = scope.iter_raw().take(scope.len().saturating_sub(known));
    let new: Vec<_> = new.filter(|(_, is_constant, _)| *is_constant).collect();
    new.into_iter().rev().map(|(name, _, value)| (name.into(), value.clone()))
}
