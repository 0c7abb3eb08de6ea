//! Table of the commands, used to execute, explain and complete them.

use super::{help, inspection, plotting, session, stepping, timing};
use crate::repl::editor::surroundings::CommandOperand;
use crate::repl::shell::{CommandOutcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::messages::suggest::nearest;
use crate::script::presentation::quantities::NAMES;

pub struct Command {
    pub name: &'static str,
    pub operand: CommandOperand,
    /// Operand as shown in the help; empty without an operand.
    pub placeholder: &'static str,
    pub summary: &'static str,
    pub doc: &'static str,
    pub body: fn(&mut Shell, &str) -> CommandOutcome,
}

pub const HELP: Command = Command {
    name: ":help",
    operand: CommandOperand::Name,
    placeholder: "[NAME]",
    summary: "explains a function, a type, a topic or a command; ?name does the same",
    doc: "Without a name it lists the commands; :help topics lists all topics.",
    body: help::help,
};

pub const QUIT: Command = Command {
    name: ":quit",
    operand: CommandOperand::Nothing,
    placeholder: "",
    summary: "exits; so does Ctrl-D",
    doc: "The words quit and exit do the same.",
    body: session::quit,
};

pub const COMMANDS: &[Command] = &[
    HELP,
    Command {
        name: ":vars",
        operand: CommandOperand::Nothing,
        placeholder: "",
        summary: "lists variables, functions and imports",
        doc: "",
        body: inspection::variables,
    },
    Command {
        name: ":step",
        operand: CommandOperand::Number,
        placeholder: "[COUNT]",
        summary: "takes one or COUNT steps of the last simulation",
        doc: "The last simulation is the one most recently started, loaded, forked or stepped.",
        body: stepping::step,
    },
    Command {
        name: ":run",
        operand: CommandOperand::Number,
        placeholder: "TIME",
        summary: "runs the last simulation to a time; Ctrl-C stops it after the current step",
        doc: "",
        body: stepping::run,
    },
    Command {
        name: ":back",
        operand: CommandOperand::Number,
        placeholder: "[COUNT]",
        summary: "goes back one or COUNT steps of the last simulation, to exactly the same state",
        doc: "Snapshots are kept as far back as their memory allows: `withy repl --snapshots MB`.",
        body: stepping::back,
    },
    Command {
        name: ":invariants",
        operand: CommandOperand::Nothing,
        placeholder: "",
        summary: "shows the drift of energy, momenta and gaps",
        doc: "",
        body: inspection::invariants,
    },
    Command {
        name: ":error",
        operand: CommandOperand::Curves,
        placeholder: "[COLUMNS]",
        summary: "estimates the errors of the last simulation in time and space",
        doc: "The run is repeated with larger steps and on other meshes, as sim.error_estimate() does. The errors of columns, such as `:error kinetic`, are drawn as thin lines above and below their values.",
        body: inspection::error_estimate,
    },
    Command {
        name: ":plot",
        operand: CommandOperand::Curves,
        placeholder: "[CURVES, OPTIONS]",
        summary: "plots columns of the history, or any expression, over time; by default the energies",
        doc: "Curves are separated by commas. Each is a column, such as `energy`, or an expression. A number or a vector, such as `sim.position(rod.end).x`, is evaluated in every stored snapshot of the simulation that it names, or of the last one. If early snapshots were discarded, the run is repeated in a copy, without functions set by sim.at, and a note says whether both runs are equal. The simulation itself does not change. An array of numbers is plotted over its index, a pair of arrays [x, y] or an array of points as a curve. `:plot drift` shows the drift of the invariants. Options of plot follow the curves: \
              `:plot kinetic, strain, #{ y_log: true, x_limits: [0, 1] }`. For pictures in files use plot and plot_history.",
        body: plotting::plot,
    },
    Command {
        name: ":show",
        operand: CommandOperand::OptionsOf("plot_motion(0, \"\", "),
        placeholder: "[TIME] [OPTIONS]",
        summary: "draws the beams at the present time, or at an earlier one",
        doc: "The initial configuration is dotted. Options of plot_motion, as in `:show #{ trace: [rod.end], magnify: 10 }`, select other dotted configurations (`every`, `from`) and paths. For pictures in files use plot_motion.",
        body: inspection::show,
    },
    Command {
        name: ":along",
        operand: CommandOperand::OneOf(NAMES),
        placeholder: "[QUANTITY]",
        summary: "draws a quantity along the beams at the present time; by default the bending moment M",
        doc: "Quantities are N, Q, M, axial_strain, shear_strain, curvature, strain_energy and speed. For pictures in files use plot_along.",
        body: inspection::along,
    },
    Command {
        name: ":view",
        operand: CommandOperand::File,
        placeholder: "[FILE]",
        summary: "writes an animated page of the last simulation for a browser",
        doc: "The page is view.html in the output folder unless another name is given. write_viewer has more options.",
        body: inspection::view,
    },
    Command {
        name: ":watch",
        operand: CommandOperand::Expression,
        placeholder: "[EXPRESSION]",
        summary: "shows an expression after every step from now on; without one, ends all watching",
        doc: "Several expressions can be watched. After other inputs they are shown once if a simulation has advanced.",
        body: stepping::watch,
    },
    Command {
        name: ":time",
        operand: CommandOperand::Expression,
        placeholder: "INPUT",
        summary: "evaluates an input repeatedly and shows its run time",
        doc: "The input is repeated with the same variables, which afterwards have the values of the first evaluation, until the median is known to 1 %, or for two seconds. Its output is printed once. An input that advances a simulation, changes a scene, writes files or takes more than a second is timed once. The first time includes parsing.",
        body: timing::time,
    },
    Command {
        name: ":explain",
        operand: CommandOperand::Nothing,
        placeholder: "",
        summary: "lists the features that the last simulation uses and omits",
        doc: "",
        body: inspection::explain,
    },
    Command {
        name: ":save",
        operand: CommandOperand::File,
        placeholder: "FILE",
        summary: "writes the successful inputs to a script",
        doc: "Only the last definition of a function is written. A file that was not written by this session, or was changed since, is not overwritten.",
        body: session::save,
    },
    Command {
        name: ":load",
        operand: CommandOperand::File,
        placeholder: "FILE [--set NAME=VALUE]",
        summary: "evaluates a script as if it had been typed",
        doc: "Each --set gives an input of the script, declared by input(…), another value than its default, until the next :load.",
        body: session::load,
    },
    Command {
        name: ":reset",
        operand: CommandOperand::Nothing,
        placeholder: "",
        summary: "forgets all variables, functions, imports and simulations",
        doc: "",
        body: session::reset,
    },
    QUIT,
];

impl Command {
    pub fn usage(&self) -> String {
        format!("{} {}", self.name, self.placeholder).trim_end().to_owned()
    }
}

/// Finds a command by its name with the colon, or by an unambiguous beginning of this name.
pub fn find(name: &str) -> Result<&'static Command, Diagnostic> {
    if let Some(exact) = COMMANDS.iter().find(|command| command.name == name) {
        return Ok(exact);
    }
    let begins = |command: &&Command| name.len() > 1 && command.name.starts_with(name);
    let candidates: Vec<&Command> = COMMANDS.iter().filter(begins).collect();
    match candidates.as_slice() {
        [one] => Ok(one),
        [] => {
            let near = nearest(name, COMMANDS.iter().map(|command| command.name));
            let hint = near.map_or_else(
                || ":help lists the commands".to_owned(),
                |near| format!("did you mean {near}?"),
            );
            Err(Diagnostic::general(format!("there is no command '{name}'")).with_hint(hint))
        }
        several => {
            let names: Vec<&str> = several.iter().map(|one| one.name).collect();
            Err(Diagnostic::general(format!("'{name}' can be {}", names.join(" or ")))
                .with_hint("type more letters"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unambiguous_command_prefixes_are_accepted() {
        let name = |text| find(text).map(|command| command.name).ok();
        assert_eq!(name(":inv"), Some(":invariants"));
        assert_eq!(name(":step"), Some(":step"));
        assert_eq!(name(":s"), None);
        let message = find(":setp").err().map(|error| error.to_string()).unwrap_or_default();
        assert!(message.contains("did you mean :step?"), "{message}");
        let message = find(":sa").map(|command| command.name);
        assert_eq!(message.ok(), Some(":save"));
    }

    #[test]
    fn command_summaries_fit_a_help_line() {
        for command in COMMANDS {
            assert!(command.usage().len() + command.summary.len() < 110, "{}", command.name);
            assert!(!command.summary.ends_with('.'), "{}", command.name);
        }
    }
}
