//! Integrators, from their registry.

use rhai::Dynamic;

use crate::integrators::Method;
use crate::script::details;
use crate::script::kind::{Details, Scripted, Type};
use crate::script::table::{Table, function};

/// Integrators.
pub const TABLE: Table = Table {
    name: "integrators",
    doc: "Ways to take a step. A scene is started with one: scene.start(#{ integrator: energy_momentum(), dt: 0.1 }).",
    types: &[INTEGRATOR],
    setup: "",
    constants: &[],
    rows: &[
        function("energy_momentum", &[], |_| Ok(Dynamic::from(Method::EnergyMomentum)))
            .returns("an integrator")
            .summary("Keeps energy and both momenta to rounding, at any step size; the default.")
            .doc("Second order. Stander & Stein, Eng. Comput. 13 (1996) 60-85.")
            .example("print(energy_momentum());")
            .see(&["trapezoidal", "start"]),
        function("trapezoidal", &[], |_| Ok(Dynamic::from(Method::Trapezoidal)))
            .returns("an integrator")
            .summary(
                "Newmark's method with β = 1/4, γ = 1/2; its energy wanders in nonlinear problems.",
            )
            .doc("Second order. Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67-94.")
            .example("print(trapezoidal());")
            .see(&["energy_momentum"]),
    ],
};

/// The integrator type, for other domains.
pub const INTEGRATOR: Type = Type::of::<Method>();

impl Scripted for Method {
    const NAME: &'static str = "integrator";
    const DOC: &'static str = "A way to take steps.";

    fn show(&self) -> String {
        let entry = self.entry();
        format!("{}: {}", entry.name, entry.summary)
    }

    fn details(&self) -> Details {
        details::of_integrator(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::INTEGRATORS;

    #[test]
    fn every_integrator_of_the_registry_has_a_row_that_cites_its_source() {
        for entry in INTEGRATORS {
            let row = TABLE.rows.iter().find(|row| row.name == entry.name).unwrap();
            assert!(
                row.doc.contains(entry.source),
                "{}: {} / {}",
                entry.name,
                row.doc,
                entry.source
            );
        }
    }
}
