//! Options for the inputs of a script, common to all commands that run scripts.

use clap::Args;

use crate::script::diagnose::Diagnostic;
use crate::script::state::inputs::{InputSetting, Inputs};

/// Inputs of a script.
#[derive(Args, Clone, Debug, Default)]
pub struct InputOptions {
    /// Sets an input of the script, such as load=250; may be repeated. withy check lists the inputs.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<InputSetting>,
}

impl InputOptions {
    /// Returns the inputs of a run.
    ///
    /// # Errors
    /// Fails if an input is set twice.
    pub fn inputs(&self) -> Result<Inputs, Diagnostic> {
        Inputs::new(self.set.clone()).map_err(|twice| {
            Diagnostic::general(twice).with_hint("give --set NAME=VALUE once for each name")
        })
    }
}
