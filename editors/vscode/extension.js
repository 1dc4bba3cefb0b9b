// The client of `rebsync lsp`, and commands that show the pages of rebsync in a panel.

const { execFile } = require("node:child_process");
const path = require("node:path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

const LANGUAGES = ["rebeca", "rebeca-property", "cpp", "python"];
const LARGEST = 256 * 1024 * 1024; // bytes of a page
// VS Code puts a background behind all code of a page that says nothing else.
const PLAIN_CODE = "<style>code { background: none; color: inherit; }</style>";

let client;
let report; // the text of the last check
const panels = new Map(); // the open pages by their titles

/** The program, which a workspace may not choose: see "scope" in package.json. */
function program() {
  return vscode.workspace.getConfiguration("rebsync").get("path");
}

async function activate(context) {
  const register = (name, task) =>
    context.subscriptions.push(vscode.commands.registerCommand(name, task));
  report = vscode.window.createOutputChannel("Rebsync");
  context.subscriptions.push(report);
  register("rebsync.verify", async () => {
    await onModel("Verification", "verify");
    if (client.isRunning()) {
      await vscode.commands.executeCommand("rebsync.verdicts"); // of the server
    }
  });
  register("rebsync.simulate", () => onModel("Simulation", "simulate"));
  register("rebsync.graph", showGraph);
  register("rebsync.diff", showDiff);
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
    askForProgram(error);
  }
}

/** Tells that the server does not start, and leads to the setting that says where it is. */
async function askForProgram(error) {
  const reason = error?.message ? ` (${error.message})` : ""; // the client may reject with nothing
  const setting = "Open the Setting";
  const chosen = await vscode.window.showErrorMessage(
    `"${program()} lsp" does not start${reason}. Install it with pip install 'rebsync[lsp]'; ` +
      `where it is not in PATH, the setting rebsync.path says where it is.`,
    setting,
  );
  if (chosen === setting) {
    await vscode.commands.executeCommand("workbench.action.openSettings", "rebsync.path");
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
  const model = modelOf(editor);
  await showPage(`${title}: ${path.basename(model)}`, [command, model, "--format", "html"]);
}

function modelOf(editor) {
  return editor.document.fileName.replace(/\.property$/, ".rebeca");
}

async function showGraph() {
  const folder = workspaceFolder();
  if (folder !== undefined) {
    const title = `Graph: ${path.basename(folder)}`;
    await showPage(title, ["graph", folder, "--format", "html"], vscode.ViewColumn.Active);
  }
}

/** Shows the page that compares the model of the active editor with the code of its package. */
async function showDiff() {
  const editor = vscode.window.activeTextEditor;
  if (editor === undefined) {
    return;
  }
  await editor.document.save();
  const model = modelOf(editor);
  const packages = await packagesOf(model);
  const chosen =
    packages.length > 1 ? await vscode.window.showQuickPick(packages) : packages[0];
  if (chosen !== undefined) {
    const title = `Diff: ${path.basename(chosen)}`;
    await showPage(title, ["diff", model, chosen, "--format", "html"]);
  } else if (packages.length === 0) {
    vscode.window.showErrorMessage(`No package of the workspace is made from ${model}`);
  }
}

/** The folders of the packages whose manifest names a model. */
async function packagesOf(model) {
  const found = [];
  for (const file of await vscode.workspace.findFiles("**/.rebsync/manifest.json")) {
    const text = Buffer.from(await vscode.workspace.fs.readFile(file)).toString();
    if (text.includes(`"name": ${JSON.stringify(path.basename(model))}`)) {
      found.push(path.dirname(path.dirname(file.fsPath)));
    }
  }
  return found.sort();
}

async function checkAll() {
  const folder = workspaceFolder();
  if (folder === undefined) {
    return;
  }
  const text = await withProgress("Check of packages", ["check", folder]);
  if (text !== undefined) {
    report.replace(text);
    report.show(true);
  }
}

function workspaceFolder() {
  const file = vscode.window.activeTextEditor?.document.uri;
  const found = file && vscode.workspace.getWorkspaceFolder(file);
  return (found ?? vscode.workspace.workspaceFolders?.[0])?.uri.fsPath;
}

/** Runs rebsync, and shows the page that it writes, whatever its verdict; in its panel, if open. */
async function showPage(title, args, column = columnOfPages()) {
  const page = await withProgress(title, args);
  if (page !== undefined) {
    const panel = panels.get(title) ?? newPanel(title, column);
    panel.webview.html = page.replace("<head>", `<head>${PLAIN_CODE}`);
    panel.reveal();
  }
}

/** Where pages are open already, beside the editor and not over it. */
function columnOfPages() {
  const own = vscode.window.activeTextEditor?.viewColumn;
  const columns = [...panels.values()].map((panel) => panel.viewColumn);
  return columns.find((c) => c !== undefined && c !== own) ?? vscode.ViewColumn.Beside;
}

function newPanel(title, column) {
  const panel = vscode.window.createWebviewPanel("rebsync", title, column, {
    enableScripts: true,
    retainContextWhenHidden: true,
  });
  panels.set(title, panel);
  panel.onDidDispose(() => panels.delete(title));
  return panel;
}

function withProgress(title, args) {
  return vscode.window.withProgress(
    { location: vscode.ProgressLocation.Notification, title, cancellable: true },
    (_, cancelled) => output(args, cancelled),
  );
}

/** What rebsync writes, whatever its exit status; undefined where that is nothing. */
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
