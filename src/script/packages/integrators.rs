//! Functions of the language that select a time integration method.

use rhai::Dynamic;

use crate::integrators::Method;
use crate::script::bindings::kind::{Details, Scripted, Type};
use crate::script::bindings::parameter::{Parameter, Presence, number, options};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::presentation::details;

pub const TABLE: BindingTable = BindingTable {
    name: "integrators",
    doc: "Time integration methods. A scene is started with one: scene.start(#{ integrator: \
        energy_momentum(), dt: 0.1 }).",
    types: &[INTEGRATOR],
    setup: "let scene = new_scene(\"example\");\n\
            scene.particle([0, 0], 1, #{ velocity: [1, 0] });",
    constants: &[],
    rows: &[
        function("energy_momentum", &[], |_| Ok(Dynamic::from(Method::EnergyMomentum)))
            .returns(Returns::object(INTEGRATOR))
            .summary("Selects the energy-momentum method (default), which keeps energy and both \
                momenta to rounding at any step size.")
            .doc("Second order. Stander & Stein, Eng. Comput. 13 (1996) 60-85.")
            .example("print(`thrown with ${energy_momentum()}`);")
            .with_related(&["fourth_order", "energy_decaying", "trapezoidal", "start"]),
        function("trapezoidal", &[], |_| Ok(Dynamic::from(Method::Trapezoidal)))
            .returns(Returns::object(INTEGRATOR))
            .summary(
                "Selects Newmark's method with β = 1/4, γ = 1/2; its energy varies in nonlinear \
                problems.",
            )
            .doc("Second order. Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67-94.")
            .example("print(trapezoidal());")
            .with_related(&["energy_momentum", "generalized_alpha"]),
        function("energy_decaying", &[options("options", CHI).optional()], |call| {
            let chi = call.options_or_defaults("options")?.number("chi")?;
            Ok(Dynamic::from(Method::EnergyDecaying { chi }))
        })
        .returns(Returns::object(INTEGRATOR))
        .summary("Selects a method that keeps both momenta to rounding and damps vibration: the \
            energy never grows, at any step size.")
        .doc(
            "Section forces are those of the mean strain of a step plus χ/2 times its change; a \
            step dissipates exactly the energy χ/2 ∫ ΔΓ·C ΔΓ + EI Δκ². First order; second \
            order with chi: 0. After Armero & Romero, Comput. Methods Appl. Mech. Eng. 190 \
            (2001) 2603-2649.",
        )
        .example("let damped = scene.start(#{ integrator: energy_decaying(#{ chi: 0.2 }), dt: 0.1 });\nprint(energy_decaying());")
        .with_related(&["energy_momentum", "generalized_alpha"]),
        function("fourth_order", &[], |_| Ok(Dynamic::from(Method::FourthOrder)))
            .returns(Returns::object(INTEGRATOR))
            .summary("Selects a fourth-order composition of seven energy-momentum steps, which keeps \
                energy and both momenta to rounding at any step size.")
            .doc(
                "Fourth order where loads and motion are smooth. A step costs as much as seven, \
                one of them backwards in time; this is efficient for small errors. Forces \
                of springs and loads are those of the last substep; all other forces, work and \
                dissipation are those of the whole step. A motion \
                that decays at a rate near 3.557/dt grows in the backward substep; this is \
                reported. The substeps are chosen so that slow loads do not excite vibrations \
                much faster than a step. A composition as in McLachlan, SIAM J. Sci. Comput. \
                16 (1995) 151-168.",
            )
            .example("print(fourth_order());")
            .with_related(&["energy_momentum"]),
        function("generalized_alpha", &[options("options", RHO_INFINITY).optional()], |call| {
            let rho_infinity = call.options_or_defaults("options")?.number("rho_infinity")?;
            Ok(Dynamic::from(Method::GeneralizedAlpha { rho_infinity }))
        })
        .returns(Returns::object(INTEGRATOR))
        .summary("Selects a method for comparison that damps fast vibration and keeps neither energy \
            nor momenta exactly.")
        .doc("Second order. First order with sliders unless rho_infinity is 1, because their \
            forces act in the middle of a step and not at the point where the method balances \
            forces. Chung & Hulbert, J. Appl. Mech. 60 (1993) 371-375.")
        .example("let damped = scene.start(#{ integrator: generalized_alpha(#{ rho_infinity: 0.8 }), dt: 0.1 });\nprint(generalized_alpha());")
        .with_related(&["trapezoidal", "energy_decaying"]),
    ],
};

const CHI: &[Parameter] = &[number("chi")
    .non_negative()
    .or(Presence::Number(0.1))
    .doc("damping parameter χ; 0 is energy_momentum")];

const RHO_INFINITY: &[Parameter] =
    &[number("rho_infinity").between(0.0, 1.0).or(Presence::Number(0.8)).doc(
        "ρ∞, factor per step of the amplitude of the fastest vibration; 1 is the trapezoidal \
        rule",
    )];

pub const INTEGRATOR: Type = Type::of::<Method>();

impl Scripted for Method {
    const NAME: &'static str = "integrator";
    const DOC: &'static str = "A time integration method.";

    fn show(&self) -> String {
        let entry = self.entry();
        let parameter = entry.parameter.zip(self.parameter());
        let tuned = parameter.map(|(of, value)| format!(" ({} = {value})", of.name));
        format!("{}{}", entry.name, tuned.unwrap_or_default())
    }

    fn details(&self) -> Details {
        details::of_integrator(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::INTEGRATORS;
    use crate::script::bindings::kind::Kind;

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
            let keys = match row.parameters {
                [Parameter { kind: Kind::Options(keys), .. }] => *keys,
                _ => &[],
            };
            let options: Vec<_> =
                keys.iter().map(|key| (key.name, key.doc, key.presence)).collect();
            let known = entry.parameter.iter();
            let known: Vec<_> =
                known.map(|of| (of.name, of.meaning, Presence::Number(of.default))).collect();
            assert_eq!(options, known, "{}", entry.name);
        }
    }
}
