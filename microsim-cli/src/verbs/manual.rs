//! `completions` and `man`: shell completions and manual pages.

use crate::console::{Console, print};
use crate::failure::Failure;
use crate::output::Outputs;
use clap::Command;
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "For bash: microsim completions bash > ~/.local/share/bash-completion/completions/microsim\n\
For zsh: microsim completions zsh > \"${fpath[1]}/_microsim\"\n\
For fish: microsim completions fish > ~/.config/fish/completions/microsim.fish")]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub shell: Shell,
}

#[derive(Debug, clap::Args)]
#[command(after_help = "To read a page: microsim man run | man -l -")]
pub(crate) struct ManArgs {
    /// The verb; two words for one of `sweep`; without it, the program
    #[arg(value_name = "VERB")]
    pub verb: Vec<String>,
    /// Write the pages of the program and of all verbs into this folder
    #[arg(long, value_name = "DIR", conflicts_with = "verb")]
    pub out: Option<PathBuf>,
}

/// Prints completions.
pub(crate) fn completions(args: &CompletionsArgs, mut program: Command) -> Result<(), Failure> {
    // The generator panics where it cannot write, so it writes to memory.
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut program, "microsim", &mut text);
    Ok(print(&text)?)
}

/// Prints or writes manual pages.
pub(crate) fn man(args: &ManArgs, mut program: Command, console: &Console) -> Result<(), Failure> {
    program.build();
    if let Some(folder) = &args.out {
        let outputs = Outputs::open(folder, true)?;
        for (name, page) in pages(&program)? {
            outputs.write(&format!("{name}.1"), &page)?;
        }
        console.note(&format!("wrote {}", folder.display()));
        return Ok(());
    }
    let mut command = &program;
    for verb in &args.verb {
        let Some(found) = command.find_subcommand(verb) else {
            let known: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
            return Err(Failure::Message(format!("there is no verb {verb:?}, accepted: {}", known.join(", "))));
        };
        command = found;
    }
    Ok(print(&page(command)?)?)
}

/// Pages of a command and of all below it, by name.
fn pages(command: &Command) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let mut all = vec![(name(command), page(command)?)];
    for verb in command.get_subcommands().filter(|verb| verb.get_name() != "help") {
        all.extend(pages(verb)?);
    }
    Ok(all)
}

fn page(command: &Command) -> Result<Vec<u8>, Failure> {
    let mut text = Vec::new();
    Man::new(command.clone()).title(name(command)).render(&mut text)?;
    Ok(text)
}

/// `microsim-sweep-plan`.
fn name(command: &Command) -> String {
    command.get_bin_name().unwrap_or(command.get_name()).replace(' ', "-")
}
