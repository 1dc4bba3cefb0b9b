// The client of `rebsync lsp`, and commands that show the pages of rebsync in a panel.

const { execFile } = require("node:child_process");
const path = require("node:path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

const LANGUAGES = ["rebeca", "rebeca-property", "cpp", "python"];
const LARGEST = 256 * 1024 * 1024; // bytes of a page

let client;

/** The program, which a workspace may not choose: see "scope" in package.json. */
function program() {
  return vscode.workspace.getConfiguration("rebsync").get("path");
}

async function activate(context) {
  const register = (name, task) =>
    context.subscriptions.push(vscode.commands.registerCommand(name, task));
  register("rebsync.verify", () => onModel("Verification", "verify"));
  register("rebsync.simulate", () => onModel("Simulation", "simulate"));
  register("rebsync.graph", showGraph);
  register("rebsync.check", checkAll);
  client = new LanguageClient(
    "rebsync",
    "rebsync",
    { command: program(), args: ["lsp"] },
    { documentSelector: LANGUAGES.map((language) => ({ scheme: "file", language })) },
  );
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(`${program()} lsp does not start: ${error.message}`);
  }
}

function deactivate() {
  return client?.stop();
}

/** Saves the model of the active editor, and shows the page of a command on it. */
async function onModel(title, command) {
  const editor = vscode.window.activeTextEditor;
  if (editor === undefined) {
    return;
  }
  await editor.document.save();
  const model = editor.document.fileName.replace(/\.property$/, ".rebeca");
  await showPage(`${title}: ${path.basename(model)}`, [command, model, "--format", "html"]);
}

async function showGraph() {
  const folder = workspaceFolder();
  if (folder !== undefined) {
    await showPage(`Graph: ${path.basename(folder)}`, ["graph", folder, "--format", "html"]);
  }
}

function checkAll() {
  const folder = workspaceFolder();
  if (folder === undefined) {
    return;
  }
  const terminal = vscode.window.createTerminal({
    name: "rebsync check",
    shellPath: program(),
    shellArgs: ["check", folder],
    cwd: folder,
  });
  terminal.show();
}

function workspaceFolder() {
  const file = vscode.window.activeTextEditor?.document.uri;
  const found = file && vscode.workspace.getWorkspaceFolder(file);
  return (found ?? vscode.workspace.workspaceFolders?.[0])?.uri.fsPath;
}

/** Runs rebsync, and shows the page that it writes, whatever its verdict. */
async function showPage(title, args) {
  const page = await vscode.window.withProgress(
    { location: vscode.ProgressLocation.Notification, title, cancellable: true },
    (_, cancelled) => output(args, cancelled),
  );
  if (page !== undefined) {
    const panel = vscode.window.createWebviewPanel("rebsync", title, vscode.ViewColumn.Beside, {
      enableScripts: true,
      retainContextWhenHidden: true,
    });
    panel.webview.html = page;
  }
}

function output(args, cancelled) {
  return new Promise((resolve) => {
    const child = execFile(program(), args, { maxBuffer: LARGEST }, (error, out, err) => {
      if (out.trim() === "") {
        if (!cancelled.isCancellationRequested) {
          vscode.window.showErrorMessage(err.trim() || error?.message || "rebsync wrote nothing");
        }
        resolve(undefined);
      } else {
        resolve(out);
      }
    });
    cancelled.onCancellationRequested(() => child.kill());
  });
}

module.exports = { activate, deactivate };
