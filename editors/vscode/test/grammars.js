// Tokenises the files of the command line; prints for each the pairs of a text and its innermost scope.

const fs = require("node:fs");
const path = require("node:path");
const { loadWASM, OnigScanner, OnigString } = require("vscode-oniguruma");
const { INITIAL, Registry } = require("vscode-textmate");

const HERE = path.dirname(__dirname);
const { grammars } = require(path.join(HERE, "package.json")).contributes;

async function main(files) {
  const wasm = require.resolve("vscode-oniguruma/release/onig.wasm");
  await loadWASM(fs.readFileSync(wasm));
  const registry = new Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new OnigScanner(patterns),
      createOnigString: (text) => new OnigString(text),
    }),
    loadGrammar: async (scope) => {
      const { path: file } = grammars.find((grammar) => grammar.scopeName === scope);
      return JSON.parse(fs.readFileSync(path.join(HERE, file), "utf-8"));
    },
  });
  for (const file of files) {
    const scope = file.endsWith(".property") ? "source.rebeca-property" : "source.rebeca";
    const grammar = await registry.loadGrammar(scope);
    const found = tokens(grammar, fs.readFileSync(file, "utf-8"));
    process.stdout.write(`${JSON.stringify({ file, tokens: found })}\n`);
  }
}

function tokens(grammar, text) {
  let stack = INITIAL;
  const found = [];
  for (const line of text.split(/\r?\n/)) {
    const result = grammar.tokenizeLine(line, stack);
    stack = result.ruleStack;
    for (const token of result.tokens) {
      found.push([line.slice(token.startIndex, token.endIndex), token.scopes.at(-1)]);
    }
  }
  return found;
}

main(process.argv.slice(2));
