//! Looking at drives, and at loads with names: what they give, and their part of the ledger.

use crate::model::Model;
use crate::model::elements::{DriveState, LoadAccount};

impl Model {
    /// What the drives have given, in the order of the scene.
    pub fn drives(&self) -> impl Iterator<Item = DriveState<'_>> {
        self.supports().prescribed().states()
    }

    /// What the loads with names have given, in the order of the scene.
    pub fn named_loads(&self) -> impl Iterator<Item = LoadAccount> {
        self.elements().forces().filter_map(|force| force.account())
    }
}
