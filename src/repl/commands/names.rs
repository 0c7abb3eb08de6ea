//! Help for names of the session: variables with their values, functions, modules, and members of values.

use rhai::{Array, Dynamic, FnAccess, Map, Module, ScriptFnMetadata};

use crate::output::significant;
use crate::repl::editor::type_before;
use crate::repl::session::{ANSWER, Reply};
use crate::repl::shell::Shell;
use crate::script::help::lookup::{HelpPage, StyledText};
use crate::script::library::page_of;
use crate::script::messages::nouns::with_article;
use crate::script::presentation::present::present;

const DIGITS: usize = 6;

/// Help for a name of the session. The text may contain source code and is shown without changes.
pub struct NameInfo {
    pub shown: Option<String>,
    pub page: HelpPage,
}

impl NameInfo {
    pub fn of_language(page: HelpPage) -> Self {
        Self { shown: None, page }
    }
}

pub fn known(shell: &mut Shell, name: &str) -> Option<NameInfo> {
    if name.contains('.') {
        return member(shell, name);
    }
    if let Some(value) = shell.session().variables().get(name).cloned() {
        return Some(variable(shell, name, &value));
    }
    let mut page = HelpPage::default();
    if name == ANSWER {
        page.heading(ANSWER);
        page.paragraph("Value of the last input that had one (at the prompt only).");
        return Some(NameInfo { shown: None, page });
    }
    for function in shell.session().functions().filter(|function| function.name == name) {
        describe(&mut page, "", &function, "a function of this session");
    }
    if let Some((alias, within)) = name.split_once("::") {
        let module = shell.session().modules().find(|(known, _)| *known == alias)?.1;
        if module.id().and_then(page_of).is_none() {
            for (.., function) in module.iter_script_fn_info() {
                let metadata: ScriptFnMetadata = (&**function).into();
                if metadata.name == within && metadata.access == FnAccess::Public {
                    describe(&mut page, alias, &metadata, "a function of an imported file");
                }
            }
        }
    } else if let Some((_, module)) = shell.session().modules().find(|(known, _)| *known == name) {
        describe_module(&mut page, name, module);
    }
    (!page.parts.is_empty()).then(|| NameInfo { shown: text_of(shell, name), page })
}

fn text_of(shell: &Shell, name: &str) -> Option<String> {
    let text = shell.session().record().definition(name)?;
    let lines = text.lines().skip_while(|line| line.trim_start().starts_with("///"));
    Some(lines.collect::<Vec<_>>().join("\n"))
}

pub fn in_language(shell: &Shell, name: &str) -> String {
    let surroundings = shell.surroundings();
    if let Some((owner, member)) = name.rsplit_once('.')
        && let Some(of) = type_before(owner, &surroundings).and_then(|kind| kind.type_name())
    {
        return format!("{of}.{member}");
    }
    let (alias, within) = name.split_once("::").unwrap_or((name, ""));
    let imported = shell.session().modules().find(|(known, _)| *known == alias);
    let Some(page) = imported.and_then(|(_, module)| module.id()).and_then(page_of) else {
        return name.to_owned();
    };
    match within {
        "" => page.module.name.to_owned(),
        _ => page.named(within).map_or_else(|| name.to_owned(), |of| of.full_name.clone()),
    }
}

fn variable(shell: &Shell, name: &str, value: &Dynamic) -> NameInfo {
    let session = shell.session();
    let kind = match (name, session.variables().is_constant(name)) {
        (ANSWER, Some(false)) => "the value of the last input that had one",
        (_, Some(true)) => "a constant",
        _ => "a variable",
    };
    let of = with_article(session.engine().map_type_name(value.type_name()));
    let mut page = HelpPage::default();
    page.words(
        0,
        vec![
            StyledText::name(name),
            StyledText::plain(format!(" is {kind}: {of}{}", extent(value))),
        ],
    );
    NameInfo { shown: Some(present(session.catalog(), value, shell.width())), page }
}

fn extent(value: &Dynamic) -> String {
    let count = |count: usize, what: &str| match count {
        1 => format!(" of 1 {what}"),
        count => format!(" of {count} {what}s"),
    };
    if let Some(map) = value.read_lock::<Map>() {
        return count(map.len(), "key");
    }
    let Some(array) = value.read_lock::<Array>() else { return String::new() };
    let number = |item: &Dynamic| {
        item.as_float().ok().or_else(|| item.as_int().ok().map(|whole| whole as f64))
    };
    let numbers: Option<Vec<f64>> = array.iter().map(number).collect();
    let of = count(array.len(), "element");
    let least = numbers.iter().flatten().copied().reduce(f64::min);
    let most = numbers.iter().flatten().copied().reduce(f64::max);
    match least.zip(most) {
        Some((least, most)) => {
            format!(
                "{of}, numbers from {} to {}",
                significant(least, DIGITS),
                significant(most, DIGITS)
            )
        }
        None => of,
    }
}

fn member(shell: &mut Shell, path: &str) -> Option<NameInfo> {
    let (first, _) = path.split_once('.')?;
    if !shell.session().variables().contains(first) || path.contains(['(', '[', '/', ':']) {
        return None;
    }
    let Reply::Value(value) = shell.session_mut().evaluate_preview(path) else { return None };
    let of = with_article(shell.session().engine().map_type_name(value.type_name()));
    let mut page = HelpPage::default();
    page.words(
        0,
        vec![StyledText::name(path), StyledText::plain(format!(" is {of}{}", extent(&value)))],
    );
    let shown = present(shell.session().catalog(), &value, shell.width());
    Some(NameInfo { shown: Some(shown), page })
}

fn describe(page: &mut HelpPage, alias: &str, function: &ScriptFnMetadata, what: &str) {
    if !page.parts.is_empty() {
        page.gap();
    }
    let path = if alias.is_empty() { String::new() } else { format!("{alias}::") };
    let of = function.this_type.map(|of| format!("{of}.")).unwrap_or_default();
    let signature = format!("{path}{of}{}({})", function.name, function.params.join(", "));
    page.words(0, vec![StyledText::name(signature), StyledText::plain(format!(" is {what}."))]);
    for line in function.comments.iter().flat_map(|comment| comment.lines()) {
        page.paragraph(line.trim_start().trim_start_matches('/').trim());
    }
}

fn describe_module(page: &mut HelpPage, alias: &str, module: &Module) {
    let from = module.id().map(|id| id.trim_end_matches(".rhai"));
    let from = from.map(|id| format!(" of \"{id}\"")).unwrap_or_default();
    page.words(
        0,
        vec![StyledText::name(alias), StyledText::plain(format!(" is an import{from}."))],
    );
    if module.id().and_then(page_of).is_some() {
        return;
    }
    for (.., function) in module.iter_script_fn_info() {
        let metadata: ScriptFnMetadata = (&**function).into();
        if metadata.access == FnAccess::Public && !metadata.name.starts_with("anon$") {
            let signature = format!("{alias}::{}({})", metadata.name, metadata.params.join(", "));
            let first = metadata.comments.iter().flat_map(|comment| comment.lines()).next();
            let first = first.map(|line| line.trim_start().trim_start_matches('/').trim());
            let about = first.map(|line| format!(": {line}")).unwrap_or_default();
            page.words(2, vec![StyledText::name(signature), StyledText::plain(about)]);
        }
    }
}
