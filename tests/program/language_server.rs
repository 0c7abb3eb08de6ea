//! The language server, driven by a client that writes and reads messages like an editor.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;

struct Client {
    server: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    folder: TempDir,
    requests: i32,
    /// Diagnostics that were read while an answer was expected.
    early: Vec<Value>,
}

fn framed(text: &str) -> String {
    format!("Content-Length: {}\r\n\r\n{text}", text.len())
}

impl Client {
    /// Starts a server whose standard library is written to the folder `cache`.
    fn start() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut server = Command::new(env!("CARGO_BIN_EXE_withy"))
            .arg("lsp")
            .current_dir(&folder)
            .env("XDG_CACHE_HOME", folder.path().join("cache"))
            .env("HOME", folder.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let input = server.stdin.take();
        let output = BufReader::new(server.stdout.take().unwrap());
        Self { server, input, output, folder, requests: 0, early: Vec::new() }
    }

    fn initialized() -> Self {
        let mut client = Self::start();
        client.request(
            "initialize",
            json!({ "processId": null, "rootUri": null, "capabilities": {} }),
        );
        client.notify("initialized", json!({}));
        client
    }

    fn write(&mut self, text: &str) {
        let input = self.input.as_mut().unwrap();
        input.write_all(framed(text).as_bytes()).and_then(|()| input.flush()).unwrap();
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.write(&json!({ "jsonrpc": "2.0", "method": method, "params": params }).to_string());
    }

    fn read(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(self.output.read_line(&mut line).unwrap() > 0, "the server has ended");
            match line.trim_end().split_once(": ") {
                Some((_, number)) => length = number.parse().unwrap(),
                None => break,
            }
        }
        let mut text = vec![0; length];
        self.output.read_exact(&mut text).unwrap();
        serde_json::from_slice(&text).unwrap()
    }

    /// Answer to a request, with `result` or `error`.
    fn request(&mut self, method: &str, params: Value) -> Value {
        self.requests += 1;
        let id = self.requests;
        let message = json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params });
        self.write(&message.to_string());
        loop {
            let message = self.read();
            match message["method"] == "textDocument/publishDiagnostics" {
                true => self.early.push(message),
                false => {
                    assert_eq!(message["id"], id, "{message}");
                    return message;
                }
            }
        }
    }

    fn refusal(&mut self, method: &str, params: Value) -> i64 {
        self.request(method, params)["error"]["code"].as_i64().unwrap()
    }

    fn uri(&self, file: &str) -> String {
        format!("file://{}", self.folder.path().join(file).display())
    }

    fn open(&mut self, file: &str, text: &str) {
        let uri = self.uri(file);
        let opened = json!({ "uri": uri, "languageId": "rhai", "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": opened }));
    }

    /// Replaces the text of an open document.
    fn change(&mut self, file: &str, version: i32, text: &str) {
        let of = json!({ "uri": self.uri(file), "version": version });
        let changes = json!([{ "text": text }]);
        self.notify(
            "textDocument/didChange",
            json!({ "textDocument": of, "contentChanges": changes }),
        );
    }

    fn diagnostics(&mut self, file: &str, version: i32) -> Vec<Value> {
        let uri = self.uri(file);
        let mut early = std::mem::take(&mut self.early).into_iter();
        loop {
            let message = early.next().unwrap_or_else(|| self.read());
            let params = &message["params"];
            if params["uri"] == uri.as_str() && params["version"] == version {
                return params["diagnostics"].as_array().unwrap().clone();
            }
        }
    }

    /// Result of a request about the place in a text that is marked by `‸`. The text becomes the document.
    fn ask_at(&mut self, method: &str, marked: &str) -> Value {
        let (before, after) = marked.split_once('‸').unwrap();
        self.open("asked.rhai", &format!("{before}{after}"));
        let line = before.matches('\n').count();
        let character = before.rsplit('\n').next().unwrap().encode_utf16().count();
        let params = json!({
            "textDocument": { "uri": self.uri("asked.rhai") },
            "position": { "line": line, "character": character },
        });
        let answer = self.request(&format!("textDocument/{method}"), params);
        assert!(answer["error"].is_null(), "{answer}");
        answer["result"].clone()
    }

    fn exit_code(mut self) -> i32 {
        self.server.wait().unwrap().code().unwrap()
    }
}

/// Start and end of a range as `line:character-line:character`.
fn place(range: &Value) -> String {
    let position = |at: &Value| format!("{}:{}", at["line"], at["character"]);
    format!("{}-{}", position(&range["start"]), position(&range["end"]))
}

#[test]
fn server_states_its_capabilities_and_ends_on_request() {
    let mut client = Client::start();
    assert_eq!(client.refusal("textDocument/hover", json!({})), -32002);
    let about = client.request("initialize", json!({ "capabilities": {} }))["result"].clone();
    assert_eq!(about["serverInfo"]["name"], "withy");
    for ability in
        ["completionProvider", "hoverProvider", "signatureHelpProvider", "definitionProvider"]
    {
        assert!(!about["capabilities"][ability].is_null(), "{about}");
    }
    assert_eq!(client.refusal("initialize", json!({ "capabilities": {} })), -32600);
    assert!(client.request("shutdown", Value::Null)["result"].is_null());
    assert_eq!(client.refusal("textDocument/hover", json!({})), -32600);
    client.notify("exit", Value::Null);
    assert_eq!(client.exit_code(), 0);
}

#[test]
fn without_shutdown_the_exit_code_is_1() {
    let mut client = Client::initialized();
    client.notify("exit", Value::Null);
    assert_eq!(client.exit_code(), 1);
    let mut client = Client::initialized();
    client.input = None;
    assert_eq!(client.exit_code(), 1);
    let mut client = Client::initialized();
    client.request("shutdown", Value::Null);
    client.input = None;
    assert_eq!(client.exit_code(), 0);
}

#[test]
fn errors_are_shown_at_their_position_until_corrected() {
    let mut client = Client::initialized();
    client.open("a.rhai", "let a = 1;\r\n  let größe𝛏 = \"𝛏\"; sqr(a);\r\n");
    let found = client.diagnostics("a.rhai", 1);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(place(&found[0]["range"]), "1:22-1:25");
    assert_eq!((&found[0]["severity"], &found[0]["source"]), (&json!(1), &json!("withy")));
    let message = found[0]["message"].as_str().unwrap();
    assert!(
        message.starts_with("there is no function 'sqr'\nhelp: did you mean 'sqrt'?"),
        "{message}"
    );
    client.change("a.rhai", 2, "let a = 1;\nsqrt(a);\n");
    assert_eq!(client.diagnostics("a.rhai", 2), [] as [Value; 0]);
    let part = json!({
        "range": { "start": { "line": 0, "character": 8 }, "end": { "line": 0, "character": 9 } },
        "text": "[",
    });
    let of = json!({ "uri": client.uri("a.rhai"), "version": 3 });
    client
        .notify("textDocument/didChange", json!({ "textDocument": of, "contentChanges": [part] }));
    let found = client.diagnostics("a.rhai", 3);
    assert_eq!(place(&found[0]["range"]), "0:9-0:10");
    assert!(fs::read_dir(client.folder.path()).unwrap().next().is_none(), "nothing is written");
}

#[test]
fn errors_are_those_of_the_command_check() {
    let mut client = Client::initialized();
    let text =
        "let scene = new_scene(\"s\");\nlet b = scene.beam(#{ axis: line([0, 0], [0, 0]) });\n";
    fs::write(client.folder.path().join("b.rhai"), text).unwrap();
    let check = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["check", "b.rhai"])
        .current_dir(&client.folder)
        .output()
        .unwrap();
    let printed = String::from_utf8(check.stderr).unwrap();
    client.open("b.rhai", text);
    let found = client.diagnostics("b.rhai", 1);
    let message = found[0]["message"].as_str().unwrap().lines().next().unwrap();
    assert!(printed.starts_with(&format!("error: {message}\n")), "{printed}");
    let start = &found[0]["range"]["start"];
    let (line, column) = (start["line"].as_u64().unwrap(), start["character"].as_u64().unwrap());
    assert!(
        printed.contains(&format!("b.rhai:{}:{}", line + 1, column + 1)),
        "{printed}\n{found:?}"
    );
}

#[test]
fn error_in_an_imported_file_is_shown_at_the_import() {
    let mut client = Client::initialized();
    let part = client.folder.path().join("part.rhai");
    fs::write(&part, "fn f() {\n  sqr(2)\n}\n").unwrap();
    client.open("main.rhai", "import \"part\" as part;\n\n  part::f();\n");
    let found = client.diagnostics("main.rhai", 1);
    assert_eq!(place(&found[0]["range"]), "2:2-2:12", "{found:?}");
    let other = &found[0]["relatedInformation"][0]["location"];
    assert_eq!(other["uri"], client.uri("part.rhai"));
    assert_eq!(place(&other["range"]), "1:2-1:5");
    fs::write(&part, "fn f() { }\n").unwrap();
    let saved = json!({ "textDocument": { "uri": client.uri("part.rhai") } });
    client.notify("textDocument/didSave", saved);
    assert_eq!(client.diagnostics("main.rhai", 1), [] as [Value; 0]);
}

#[test]
fn pitfalls_are_warnings() {
    let mut client = Client::initialized();
    client.open("a.rhai", "let a = 7 // 2\n    ;\n");
    let found = client.diagnostics("a.rhai", 1);
    assert_eq!((found.len(), &found[0]["severity"]), (1, &json!(2)), "{found:?}");
    assert_eq!(place(&found[0]["range"]), "0:10-0:14");
}

#[test]
fn endless_check_does_not_delay_answers_and_ends_after_edits() {
    let mut client = Client::initialized();
    client.open("long.rhai", "let sum = 0;\nloop { sum += 1; }\n");
    let hover = client.ask_at("hover", "sq‸rt(2)");
    assert!(hover["contents"]["value"].as_str().unwrap().starts_with("sqrt(x)"), "{hover}");
    client.change("long.rhai", 2, "let sum = ;\n");
    assert_eq!(client.diagnostics("long.rhai", 2).len(), 1);
}

const SCENE: &str = "let scene = new_scene(\"ξ\");\nlet rod = scene.beam(#{ axis: line([0, 0], [1, 0]), section: section(#{ EA: 1, GA: 1, EI: 1, rho_A: 1, rho_I: 1 }) });\nlet sim = scene.start(#{ dt: 0.1 });\n";

#[test]
fn members_options_and_own_names_are_completed() {
    let mut client = Client::initialized();
    let mut labels = |marked: &str| -> Vec<(String, String, String)> {
        let items = client.ask_at("completion", marked);
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        let item = |item: &Value| {
            let edit = &item["textEdit"];
            (text(&item["label"]), text(&edit["newText"]), place(&edit["range"]))
        };
        items.as_array().unwrap().iter().map(item).collect()
    };
    let found = labels(&format!("{SCENE}\"𝛏\"; sim.run‸\nnext();"));
    assert!(
        found
            .iter()
            .any(|(label, new, at)| label == "run_to(t)" && new == "run_to(" && at == "3:10-3:13"),
        "{found:?}"
    );
    let found = labels(&format!("{SCENE}scene.start(#{{\n    in‸"));
    assert_eq!(found, [("integrator".into(), "integrator: ".into(), "4:4-4:6".into())]);
    let found = labels(&format!("{SCENE}fn swing(angle, speed) {{\n    ang‸"));
    assert!(found.iter().any(|(label, ..)| label == "angle"), "{found:?}");
    let found = labels("import \"std/sections\" as parts;\nparts::rect‸");
    assert!(found.iter().any(|(label, ..)| label.starts_with("rectangle(")), "{found:?}");
    assert_eq!(labels("let a = 1;\n    ‸"), []);
    assert!(!labels("‸").is_empty());
}

#[test]
fn colon_offers_completions_only_after_a_module() {
    let mut client = Client::initialized();
    let mut typed = |text: &str| {
        client.open("typed.rhai", text);
        let params = json!({
            "textDocument": { "uri": client.uri("typed.rhai") },
            "position": { "line": 1, "character": 99 },
            "context": { "triggerKind": 2, "triggerCharacter": ":" },
        });
        client.request("textDocument/completion", params)["result"].clone()
    };
    assert!(typed("\nscene.beam(#{ axis:").is_null());
    assert!(!typed("import \"std/shapes\" as shapes;\nshapes::").as_array().unwrap().is_empty());
}

#[test]
fn hover_shows_the_help_of_the_program() {
    let mut client = Client::initialized();
    let docs = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["docs", "simulation.run_to"])
        .env("COLUMNS", "80")
        .output()
        .unwrap();
    let docs = String::from_utf8(docs.stdout).unwrap();
    let hover = client.ask_at("hover", &format!("{SCENE}sim.run‸_to(1);"));
    assert_eq!(hover["contents"], json!({ "kind": "plaintext", "value": docs }));
    assert_eq!(place(&hover["range"]), "3:4-3:10");
    let mut text = |marked: &str| {
        client.ask_at("hover", marked)["contents"]["value"].as_str().unwrap_or_default().to_owned()
    };
    let shown = text("/// Doubles a number.\nfn twice(x) { 2 * x }\ntwi‸ce(2);");
    assert!(
        shown.starts_with("twice(x) is a function of this session.\nDoubles a number."),
        "{shown}"
    );
    let shown = text("sqr(2);\nlet k = half(3);\nfn half(x) { x / 2 }\nhal‸f(1);");
    assert!(shown.starts_with("half(x) is a function of this session."), "{shown}");
    let shown = text(&format!("{SCENE}ro‸d.length"));
    assert!(shown.starts_with("rod is a variable: a beam\n"), "{shown}");
    let shown = text("import \"std/sections\" as parts;\nparts::rect‸angle(1, 1, 1, 1);");
    assert!(shown.starts_with("sections::rectangle("), "{shown}");
    let shown = text("section(#{ rho‸_A: 1 })");
    assert!(shown.contains("An option of section(options):\n  rho_A: a number"), "{shown}");
    assert_eq!(text("let a = 12‸3;"), "");
    assert_eq!(text("// sq‸rt"), "");
}

#[test]
fn a_call_shows_its_signature_with_the_current_parameter() {
    let mut client = Client::initialized();
    let help = client.ask_at("signatureHelp", "line([0, 0], ‸)");
    let of = &help["signatures"][0];
    assert_eq!(of["label"], "line(from, to)");
    assert_eq!(of["parameters"][0]["label"], json!([11, 13]));
    assert!(of["documentation"].as_str().unwrap().starts_with("to: a point [x, y]"), "{help}");
    let help =
        client.ask_at("signatureHelp", "sqr(2);\nswing(1, ‸\n);\nfn swing(angle, speed) { }");
    assert_eq!(help["signatures"][0]["label"], "swing(angle, speed)");
    let help = client.ask_at("signatureHelp", &format!("{SCENE}scene.start(#{{ dt: 1, ‸"));
    assert_eq!(help["signatures"][0]["label"], "integrator, name, notes, record, snapshots");
    assert!(client.ask_at("signatureHelp", "let a = 1;‸").is_null());
}

#[test]
fn definitions_are_found_in_the_file_in_imports_and_in_the_library() {
    let mut client = Client::initialized();
    fs::write(
        client.folder.path().join("part.rhai"),
        "let älter = 2;\n/// Half.\nfn half(x) { x / 2 }\n",
    )
    .unwrap();
    let mut places = |marked: &str| -> Vec<(String, String)> {
        let found = client.ask_at("definition", marked);
        let place = |at: &Value| (at["uri"].as_str().unwrap().to_owned(), place(&at["range"]));
        found.as_array().map_or_else(Vec::new, |found| found.iter().map(place).collect())
    };
    let found = places("let 𝛏 = 1; let arm = 2;\nprint(ar‸m);");
    assert!(found[0].0.ends_with("/asked.rhai") && found[0].1 == "0:16-0:19", "{found:?}");
    let found = places("swing‸(1);\nfn swing(angle) { angle }");
    assert_eq!(found[0].1, "1:3-1:8");
    let found = places("import \"part\" as part;\npart::ha‸lf(2);");
    assert!(found[0].0.ends_with("/part.rhai") && found[0].1 == "2:3-2:7", "{found:?}");
    let found = places("import \"std/sections\" as s;\ns::rect‸angle(1, 1, 1, 1);");
    let file = found[0].0.strip_prefix("file://").unwrap();
    assert!(file.ends_with("/std/sections.rhai"), "{file}");
    let line: usize = found[0].1.split(':').next().unwrap().parse().unwrap();
    let text = fs::read_to_string(Path::new(file)).unwrap();
    assert!(text.lines().nth(line).unwrap().starts_with("fn rectangle("), "{found:?}");
    assert_eq!(places("import \"nowhere\" as s;\ns::rect‸angle(1);"), []);
    assert_eq!(places("sq‸rt(2)"), []);
}

#[test]
fn invalid_requests_are_rejected_and_the_server_continues() {
    let mut client = Client::initialized();
    assert_eq!(client.refusal("textDocument/rename", json!({})), -32601);
    assert_eq!(client.refusal("textDocument/hover", json!({ "position": 3 })), -32602);
    let place = json!({ "textDocument": { "uri": "file:///no.rhai" }, "position": { "line": 0, "character": 0 } });
    assert_eq!(client.refusal("textDocument/hover", place), -32602);
    client.notify("textDocument/didOpen", json!([1]));
    client.notify("$/unknown", json!({}));
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": "file:///no.rhai", "version": 1 }, "contentChanges": [] }),
    );
    for text in ["{\"jsonrpc\": ", "[]", "{\"id\": 1.5}"] {
        client.write(text);
        let answer = client.read();
        assert_eq!(
            (&answer["error"]["code"], &answer["id"]),
            (&json!(-32700), &Value::Null),
            "{text}"
        );
    }
    assert!(client.request("shutdown", Value::Null)["result"].is_null());
}

#[test]
fn unfinished_texts_do_not_end_the_server() {
    let mut client = Client::initialized();
    let text = "let a = \"𝛏\r\nscene.beam(#{ axis: `${x\n:save b.rhai\n?help\nfn f(|x| { import \"std/sections\" as s; s::";
    let step = if std::env::var_os("WITHY_LONG").is_some() { 1 } else { 7 };
    for end in (0..=text.len()).step_by(step).filter(|end| text.is_char_boundary(*end)) {
        let marked = format!("{}‸", &text[..end]);
        for method in ["completion", "hover", "signatureHelp", "definition"] {
            client.ask_at(method, &marked);
        }
    }
    let entries = fs::read_dir(client.folder.path()).unwrap();
    let names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
    assert!(!names.contains(&"b.rhai".into()), "commands of the prompt are not executed");
    for text in ["", "\r", "\u{feff}let a = 1;", "#!/usr/bin/env withy\nlet a = 1;\n"] {
        client.open("empty.rhai", text);
        assert_eq!(client.diagnostics("empty.rhai", 1), [] as [Value; 0], "{text:?}");
    }
    let hover = client.ask_at("hover", "#!/usr/bin/env withy\nlet 𝛏 = 1;\nsq‸rt(2)");
    assert_eq!(place(&hover["range"]), "2:0-2:4");
}

#[test]
fn a_closed_document_has_no_diagnostics() {
    let mut client = Client::initialized();
    client.open("untitled.rhai", "let = 1;");
    assert_eq!(client.diagnostics("untitled.rhai", 1).len(), 1);
    let uri = client.uri("untitled.rhai");
    client.notify("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
    let message = client.read();
    assert_eq!(message["params"], json!({ "uri": uri, "diagnostics": [] }));
}

#[test]
fn help_of_the_lsp_command_describes_it() {
    let output =
        Command::new(env!("CARGO_BIN_EXE_withy")).args(["lsp", "--help"]).output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    assert!(help.starts_with("Starts the language server for editors"), "{help}");
}
