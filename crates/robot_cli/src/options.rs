//! The options of generated code on the command line, taken from the table that declares them.

use crate::values::whole;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use robot_build::{Commands, Kind, OPTIONS, OptionSpec, Options, Value};

/// The help text of an option.
pub(crate) fn help(name: &str) -> &'static str {
    OptionSpec::named(name).map_or("", |option| option.help)
}

/// The name of an option's value in the help.
pub(crate) fn value_name(name: &str) -> &'static str {
    OptionSpec::named(name).map_or("", |option| option.value_name)
}

/// Words in messages of libraries, for options that are not in the table and for work of commands, and their
/// replacements in messages of the command.
const OTHERS: [(&str, &str); 5] = [
    ("the import option `friction`", "`import --friction`"),
    ("the option `rustc`", "`--rustc`"),
    ("run a search for a cheaper plan", "search for a cheaper plan with `robot-symbolic search`"),
    ("give `--scalar` the value `f32`", "use `--scalar f32`"),
    ("measure the compiled code", "measure it with `robot-symbolic prove`"),
];

/// Rewrites a message of a library for the command: "the option `allow_massless`" becomes `--allow-massless`.
pub(crate) fn in_flags(message: &str) -> String {
    let known = OPTIONS
        .iter()
        .map(|option| (format!("the option `{}`", option.name), format!("`{}`", option.flag())));
    let others = OTHERS.map(|(words, flag)| (words.to_owned(), flag.to_owned()));
    known.chain(others).fold(message.to_owned(), |text, (words, flag)| text.replace(&words, &flag))
}

/// The words that an option can have as its value.
pub(crate) fn choice(name: &str) -> PossibleValuesParser {
    match OptionSpec::named(name).map(|option| option.kind) {
        Some(Kind::Choice(words)) => words_of(words),
        _ => PossibleValuesParser::new(Vec::<PossibleValue>::new()),
    }
}

fn words_of(words: &[(&'static str, &'static str)]) -> PossibleValuesParser {
    let word = |(word, help): &(&'static str, &'static str)| match *help {
        "" => PossibleValue::new(*word),
        help => PossibleValue::new(*word).help(help),
    };
    PossibleValuesParser::new(words.iter().map(word).collect::<Vec<_>>())
}

/// The options for printing and optimizing code, for the commands that generate code.
#[derive(Clone)]
pub(crate) struct CodeOptions {
    values: Vec<(&'static OptionSpec, Given)>,
    /// The names of the options on the command line; the others have their defaults.
    given: Vec<&'static str>,
}

/// A value from the command line.
#[derive(Clone)]
enum Given {
    Flag,
    Count(u64),
    Word(String),
}

impl CodeOptions {
    /// Sets the given options in `options`.
    pub(crate) fn set(&self, options: &mut Options) {
        for (option, given) in &self.values {
            let value = match given {
                Given::Flag => Value::Flag(true),
                Given::Count(count) => Value::Count(*count),
                Given::Word(word) => Value::Word(word),
            };
            // The parsers of the arguments accept only valid values.
            let _ = option.set(options, value);
        }
    }

    /// Whether the command line has the option with this name.
    pub(crate) fn is_given(&self, name: &str) -> bool {
        self.given.contains(&name)
    }
}

/// The options of the table that are flags with at most one plain value.
fn listed() -> impl Iterator<Item = &'static OptionSpec> {
    let plain = |kind| matches!(kind, Kind::Flag | Kind::Count { .. } | Kind::Choice(_));
    OPTIONS.iter().filter(move |option| option.commands == Commands::Code && plain(option.kind))
}

fn argument(option: &'static OptionSpec) -> Arg {
    let mut argument = Arg::new(option.name)
        .long(option.flag().trim_start_matches('-').to_owned())
        .help(option.help);
    if let Some(required) = option.requires {
        argument = argument.requires(required);
    }
    match option.kind {
        Kind::Count { default } => {
            let argument = argument.value_name(option.value_name).value_parser(whole(0_u64..));
            match default {
                Some(number) => argument
                    .num_args(0..=1)
                    .require_equals(true)
                    .default_missing_value(number.to_string()),
                None => argument,
            }
        }
        Kind::Choice(words) => {
            let usual = words.first().map_or("", |(word, _)| word);
            argument.value_parser(words_of(words)).default_value(usual)
        }
        _ => argument.action(ArgAction::SetTrue),
    }
}

impl Args for CodeOptions {
    fn augment_args(command: Command) -> Command {
        command.args(listed().map(argument))
    }

    fn augment_args_for_update(command: Command) -> Command {
        CodeOptions::augment_args(command)
    }
}

impl FromArgMatches for CodeOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<CodeOptions, clap::Error> {
        let given = |option: &'static OptionSpec| {
            let given = match option.kind {
                Kind::Flag => matches.get_flag(option.name).then_some(Given::Flag),
                Kind::Count { .. } => matches.get_one(option.name).copied().map(Given::Count),
                _ => matches.get_one(option.name).cloned().map(Given::Word),
            };
            given.map(|given| (option, given))
        };
        let is_given = |name: &&str| matches.value_source(name) == Some(ValueSource::CommandLine);
        Ok(CodeOptions {
            values: listed().filter_map(given).collect(),
            given: listed().map(|option| option.name).filter(is_given).collect(),
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = CodeOptions::from_arg_matches(matches)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(clap::Parser)]
    struct Arguments {
        #[command(flatten)]
        code: CodeOptions,
    }

    #[test]
    fn flags_set_what_the_table_sets() {
        for option in listed() {
            let value = option.example.trim_matches('"');
            let mut arguments = vec!["name".to_owned()];
            match option.kind {
                Kind::Flag => arguments.push(option.flag()),
                _ => arguments.push(format!("{}={value}", option.flag())),
            }
            let required = option.requires.and_then(OptionSpec::named);
            if let Some(required) = required {
                arguments.push(format!("{}={}", required.flag(), required.example));
            }
            let parsed = <Arguments as clap::Parser>::try_parse_from(&arguments).unwrap();
            let (mut found, mut expected) = (Options::default(), Options::default());
            parsed.code.set(&mut found);
            option.set(&mut expected, option.value(option.example).unwrap()).unwrap();
            if let Some(required) = required {
                required.set(&mut expected, required.value(required.example).unwrap()).unwrap();
                assert!(
                    <Arguments as clap::Parser>::try_parse_from(&arguments[..2]).is_err(),
                    "{arguments:?}"
                );
            }
            assert_eq!(found, expected, "{arguments:?}");
        }
        let alone = <Arguments as clap::Parser>::try_parse_from(["name", "--batch"]).unwrap();
        let mut found = Options::default();
        alone.code.set(&mut found);
        assert_eq!(found.batch, Some(robot_build::DEFAULT_BATCH));
        assert!(<Arguments as clap::Parser>::try_parse_from(["name", "--parallel"]).is_err());
    }

    #[test]
    fn arguments_take_the_words_of_the_table_and_no_others() {
        for option in OPTIONS {
            assert_eq!(
                (help(option.name), value_name(option.name)),
                (option.help, option.value_name)
            );
            let argument = Arg::new("one").long("one").value_parser(choice(option.name));
            let command = Command::new("name").arg(argument);
            let parsed = |word: &str| {
                let found = command.clone().try_get_matches_from(["name", "--one", word]).ok()?;
                found.get_one::<String>("one").cloned()
            };
            let words = if let Kind::Choice(words) = option.kind { words } else { &[] };
            for (word, _) in words {
                assert_eq!(parsed(word).as_deref(), Some(*word), "{}", option.name);
            }
            for other in ["", "other", "true", option.example] {
                assert_eq!(parsed(other), None, "{}", option.name);
            }
        }
        assert_eq!((help("none"), value_name("none")), ("", ""));
    }

    #[test]
    fn messages_name_flags() {
        for option in OPTIONS {
            let message = in_flags(&format!("use the option `{}` here", option.name));
            assert_eq!(message, format!("use `{}` here", option.flag()));
        }
        for (words, flag) in OTHERS {
            assert_eq!(in_flags(&format!("Please {words}.")), format!("Please {flag}."));
        }
        assert_eq!(in_flags("the option `none`"), "the option `none`");
    }
}
