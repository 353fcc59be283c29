//! The program `uplift`.

use std::io::Write;
use std::process::ExitCode;

mod command;
mod error;
mod show;
mod terminal;

use terminal::Terminal;

/// A panic is a bug of the program; everything a user can cause is an error with a message.
const EXIT_BUG: i32 = 1;

/// A file that grows beyond the limit of the process (`ulimit -f`) is then an error, as on a full disk, and does not
/// end the program without a word.
#[cfg(unix)]
fn outlive_the_file_size_limit() {
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

fn main() -> ExitCode {
    #[cfg(unix)]
    outlive_the_file_size_limit();
    std::panic::set_hook(Box::new(|info| {
        // where nobody listens any more, a panic within this one would end the program without its exit code
        let _ = writeln!(
            terminal::error_output(),
            "uplift: a bug in the program: {info}\nPlease report it with the study file and this line. No result file \
             is left half written."
        );
        end_at_once();
    }));
    let arguments = command::typed();
    let terminal = Terminal::new(arguments.quiet, arguments.details, arguments.progress);
    match command::execute(&arguments, &terminal) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            terminal.tell_error(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

/// Ends the program as a kill does: nothing is unwound, and on Unix nothing that other threads are at is waited for.
/// What is half written has names of its own, which the next writer of the same file clears up.
fn end_at_once() -> ! {
    #[cfg(unix)]
    signal_hook::low_level::exit(EXIT_BUG);
    #[cfg(not(unix))]
    std::process::exit(EXIT_BUG)
}
