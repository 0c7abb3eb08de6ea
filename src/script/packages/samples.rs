//! Distributions of the parameters of sweeps, and sampling methods.

use rhai::Dynamic;

use crate::sampling::Distribution;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::{Parameter, Presence, integer, number};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, FunctionBinding, NativeFunction, function};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::script::studies::sweeps::design::{SampleKind, Samples};

pub const TABLE: BindingTable = BindingTable {
    name: "samples",
    doc: "Distributions of parameters and sampling plans for sweeps. Random numbers are those of \
        ChaCha with twelve rounds, seeded by the seed: equal seeds give equal points on every \
        machine.",
    types: &[DISTRIBUTION, SAMPLES],
    setup: "",
    constants: &[],
    rows: &[
        spread("uniform", &[FROM, TO], |call| {
            let (from, to) = ends(call)?;
            Ok(Dynamic::from(Distribution::Uniform { from, to }))
        })
        .summary("Creates a uniform distribution between two numbers, for a parameter of a sweep.")
        .example("check(uniform(0.1, 2).to_string() == \"uniform(0.1, 2)\");"),
        spread("log_uniform", &[FROM.positive(), TO.positive()], |call| {
            let (from, to) = ends(call)?;
            Ok(Dynamic::from(Distribution::LogUniform { from, to }))
        })
        .summary(
            "Creates a distribution with a uniform logarithm between two numbers, for a \
            parameter of a sweep.",
        )
        .example("print(log_uniform(1e-3, 10));"),
        spread("normal", &[number("mean"), DEVIATION], |call| {
            let (mean, deviation) = (call.number("mean")?, call.number("deviation")?);
            Ok(Dynamic::from(Distribution::Normal { mean, deviation }))
        })
        .summary(
            "Creates a normal distribution with a mean and a standard deviation, for a \
            parameter of a sweep.",
        )
        .example("print(normal(100, 5));"),
        spread("log_normal", &[number("median").positive(), DEVIATION], |call| {
            let (median, deviation) = (call.number("median")?, call.number("deviation")?);
            Ok(Dynamic::from(Distribution::LogNormal { median, deviation }))
        })
        .summary(
            "Creates a distribution with a normal logarithm, for a parameter of a sweep, from \
            the median and the standard deviation of the logarithm.",
        )
        .example("print(log_normal(100, 0.05));"),
        spread("triangular", &[FROM, number("likeliest"), TO], |call| {
            let (from, to) = ends(call)?;
            let mode = call.number("likeliest")?;
            match (from..=to).contains(&mode) {
                true => Ok(Dynamic::from(Distribution::Triangular { from, mode, to })),
                false => {
                    let [mode, from, to] = [mode, from, to].map(format_number);
                    let message =
                        format!("the likeliest number {mode} is not between {from} and {to}");
                    Err(call
                        .error(message)
                        .hint("write triangular(from, likeliest, to)")
                        .at(CallPart::Argument(1)))
                }
            }
        })
        .summary(
            "Creates a triangular distribution between two numbers with its maximum at the \
            likeliest number, for a parameter of a sweep.",
        )
        .example("print(triangular(90, 100, 120));"),
        points("latin_hypercube", &[COUNT, SEED], |call| samples(call, SampleKind::LatinHypercube))
            .summary(
                "Creates a Latin hypercube plan for a sweep: each parameter range is divided \
                into as many equally likely parts as there are points, with one point in each \
                part.",
            )
            .doc("M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239-245.")
            .example("print(latin_hypercube(2000));")
            .with_related(&["study_sweep", "sobol"]),
        points("sobol", &[COUNT, SEED], |call| samples(call, SampleKind::Sobol))
            .summary(
                "Creates a plan of evenly distributed points for a sweep from a Sobol' \
                sequence; a power of two of points is best.",
            )
            .doc(
                "Direction numbers of S. Joe and F. Y. Kuo (SIAM J. Sci. Comput. 30 (2008) \
                2635-2654), for up to 40 parameters; each coordinate is shifted by random bits \
                of the seed (a digital shift).",
            )
            .example("print(sobol(4096, 7));")
            .with_related(&["study_sweep", "saltelli"]),
        points(
            "saltelli",
            &[
                integer("blocks")
                    .positive()
                    .doc("number of blocks, each with two runs more than the number of parameters"),
                SEED,
            ],
            |call| samples(call, SampleKind::Saltelli),
        )
        .summary(
            "Creates a plan for a sweep from which sensitivity() computes first-order and total \
            Sobol' indices.",
        )
        .doc(
            "A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270; the points \
            of a Sobol' sequence, in blocks of two more than the number of parameters.",
        )
        .example("print(saltelli(1024));")
        .with_related(&["sensitivity", "sobol"]),
    ],
};

const DISTRIBUTION: Type = Type::of::<Distribution>();
pub(super) const SAMPLES: Type = Type::of::<Samples>();
const FROM: Parameter = number("from");
const TO: Parameter = number("to");
const DEVIATION: Parameter = number("deviation").positive();
const COUNT: Parameter = integer("count").positive();
const SEED: Parameter = integer("seed").non_negative().or(Presence::Integer(0));

const fn spread(
    name: &'static str,
    parameters: &'static [Parameter],
    body: NativeFunction,
) -> FunctionBinding {
    function(name, parameters, body)
        .returns(Returns::object(DISTRIBUTION))
        .with_related(&["study_sweep"])
}

const fn points(
    name: &'static str,
    parameters: &'static [Parameter],
    body: NativeFunction,
) -> FunctionBinding {
    function(name, parameters, body).returns(Returns::object(SAMPLES))
}

impl Scripted for Distribution {
    const NAME: &'static str = "distribution";
    const DOC: &'static str = "Distribution of a parameter of a sweep.";

    fn show(&self) -> String {
        self.describe()
    }
}

impl Scripted for Samples {
    const NAME: &'static str = "samples";
    const DOC: &'static str = "Sampling plan for the parameters of a sweep.";

    fn show(&self) -> String {
        let Self { kind, count, seed } = self;
        let kind = match kind {
            SampleKind::LatinHypercube => "latin_hypercube",
            SampleKind::Sobol => "sobol",
            SampleKind::Saltelli => "saltelli",
        };
        match seed {
            0 => format!("{kind}({count})"),
            seed => format!("{kind}({count}, {seed})"),
        }
    }
}

fn ends(call: &Call) -> Result<(f64, f64), ScriptError> {
    let (from, to) = (call.number("from")?, call.number("to")?);
    match from < to {
        true => Ok((from, to)),
        false => {
            let message =
                format!("the range from {} to {} is empty", format_number(from), format_number(to));
            Err(call.error(message).hint("give the smaller number first").at(CallPart::Argument(0)))
        }
    }
}

fn samples(call: &Call, kind: SampleKind) -> Result<Dynamic, ScriptError> {
    let count = call.count(if kind == SampleKind::Saltelli { "blocks" } else { "count" })?;
    Ok(Dynamic::from(Samples { kind, count, seed: call.count("seed")? as u64 }))
}
