// Starts the language server `withy lsp`.
const { workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

exports.activate = () => {
  const command = workspace.getConfiguration("withy").get("path");
  const server = { command, args: ["lsp"] };
  client = new LanguageClient("withy", "withy", server, { documentSelector: [{ language: "rhai" }] });
  return client.start();
};

exports.deactivate = () => client?.stop();
