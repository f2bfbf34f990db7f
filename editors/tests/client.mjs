// An editor as small as one can be: it starts the server and speaks the protocol with the library
// that VS Code's own client is built on.

import { spawn } from "node:child_process";
import { pathToFileURL } from "node:url";
import {
  CodeActionRequest, CodeLensRequest, CodeLensResolveRequest, CompletionRequest,
  createProtocolConnection, DidChangeTextDocumentNotification, DidOpenTextDocumentNotification,
  DocumentFormattingRequest, ExitNotification, HoverRequest, InitializedNotification,
  InitializeRequest, PublishDiagnosticsNotification, RenameRequest, ShutdownRequest,
  StreamMessageReader, StreamMessageWriter,
} from "vscode-languageserver-protocol/node";

export const COMMAND = process.env.SETPIECE ?? "setpiece";
/** How long an answer may take on a slow machine, in milliseconds. */
const PATIENCE = 30_000;

/** What the editor says that it can do. */
const CAPABILITIES = {
  workspace: { workspaceEdit: { documentChanges: true } },
  textDocument: {
    codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ["quickfix"] } } },
    completion: { completionItem: { snippetSupport: true } },
    documentSymbol: { hierarchicalDocumentSymbolSupport: true },
    hover: { contentFormat: ["markdown"] },
    publishDiagnostics: { relatedInformation: true, codeDescriptionSupport: true },
  },
};

/** A running server, and the texts that are open in it. */
export class Editor {
  #process = spawn(COMMAND, ["lsp"], { stdio: ["pipe", "pipe", "inherit"] });
  #connection = createProtocolConnection(
    new StreamMessageReader(this.#process.stdout), new StreamMessageWriter(this.#process.stdin),
  );
  #texts = new Map();
  #diagnostics = new Map();
  #waiting = new Set();

  static async start(folder) {
    const editor = new Editor();
    editor.#connection.onNotification(PublishDiagnosticsNotification.type, (published) => {
      editor.#diagnostics.set(published.uri, published.diagnostics);
      for (const look of editor.#waiting) look();
    });
    editor.#connection.listen();
    const rootUri = pathToFileURL(folder).href;
    editor.server = await editor.#connection.sendRequest(InitializeRequest.type, {
      processId: process.pid, rootUri, capabilities: CAPABILITIES,
      workspaceFolders: [{ uri: rootUri, name: "drills" }],
    });
    await editor.#connection.sendNotification(InitializedNotification.type, {});
    return editor;
  }

  async stop() {
    await this.#connection.sendRequest(ShutdownRequest.type);
    const gone = new Promise((resolve) => this.#process.once("exit", resolve));
    await this.#connection.sendNotification(ExitNotification.type);
    return gone;
  }

  async open(uri, text) {
    this.#texts.set(uri, { version: 1, text });
    const textDocument = { uri, languageId: "pitch", version: 1, text };
    await this.#connection.sendNotification(DidOpenTextDocumentNotification.type, { textDocument });
  }

  text(uri) {
    return this.#texts.get(uri).text;
  }

  /** Replaces a text as a whole. */
  async write(uri, text) {
    const version = this.#texts.get(uri).version + 1;
    this.#texts.set(uri, { version, text });
    await this.#connection.sendNotification(DidChangeTextDocumentNotification.type, {
      textDocument: { uri, version }, contentChanges: [{ text }],
    });
  }

  /** Makes the edits of a `WorkspaceEdit` in the open texts. */
  async apply(edit) {
    const byDocument = (edit.documentChanges ?? []).map((it) => [it.textDocument.uri, it.edits]);
    for (const [uri, edits] of [...Object.entries(edit.changes ?? {}), ...byDocument]) {
      await this.write(uri, edited(this.text(uri), edits));
    }
  }

  /** The position of the first occurrence of some words, or of the end of them. */
  position(uri, words, atEnd = false) {
    const start = this.text(uri).indexOf(words);
    if (start < 0) throw new Error(`no ${words} in the text`);
    const before = this.text(uri).slice(0, atEnd ? start + words.length : start);
    const line = before.split("\n").length - 1;
    return { line, character: before.length - (before.lastIndexOf("\n") + 1) };
  }

  /** The problems of a text, as soon as they fit. */
  async diagnostics(uri, fit) {
    return new Promise((resolve, reject) => {
      const fail = () => {
        this.#waiting.delete(look);
        reject(new Error(`the problems are ${JSON.stringify(this.#diagnostics.get(uri))}`));
      };
      const timer = setTimeout(fail, PATIENCE);
      const look = () => {
        const found = this.#diagnostics.get(uri);
        if (!found || !fit(found)) return;
        clearTimeout(timer);
        this.#waiting.delete(look);
        resolve(found);
      };
      this.#waiting.add(look);
      look();
    });
  }

  request(method, params) {
    return this.#connection.sendRequest(method, params);
  }

  hover(uri, words) {
    return this.#at(HoverRequest.type, uri, words);
  }

  async complete(uri, words) {
    const found = await this.#at(CompletionRequest.type, uri, words, {}, true);
    return Array.isArray(found) ? found : found?.items ?? [];
  }

  rename(uri, words, newName) {
    return this.#at(RenameRequest.type, uri, words, { newName });
  }

  async format(uri) {
    const options = { tabSize: 4, insertSpaces: true };
    const asked = { textDocument: { uri }, options };
    return edited(this.text(uri), await this.request(DocumentFormattingRequest.type, asked) ?? []);
  }

  async lenses(uri) {
    const lenses = await this.request(CodeLensRequest.type, { textDocument: { uri } });
    const whole = (lens) => lens.command ? lens : this.request(CodeLensResolveRequest.type, lens);
    return Promise.all(lenses.map(whole));
  }

  preview(uri, words) {
    const position = this.position(uri, words);
    return this.request("setpiece/preview", { textDocument: { uri }, position });
  }

  /** Drops a player of a drawn start, or the ball, elsewhere: makes the edits, or says why not. */
  async drag(uri, drawn, name, to) {
    const { version, scenario, things } = drawn;
    const { player } = things.find((thing) => thing.name === name);
    const asked = { textDocument: { uri, version }, scenario, player, to };
    const { message, edits } = await this.request("setpiece/move", asked);
    if (edits) await this.write(uri, edited(this.text(uri), edits));
    return message;
  }

  fixes(uri, diagnostic) {
    return this.request(CodeActionRequest.type, {
      textDocument: { uri }, range: diagnostic.range,
      context: { diagnostics: [diagnostic], only: ["quickfix"] },
    });
  }

  #at(type, uri, words, more = {}, atEnd = false) {
    const position = this.position(uri, words, atEnd);
    return this.request(type, { textDocument: { uri }, position, ...more });
  }
}

/** A text with edits made, from the last one to the first. */
function edited(text, edits) {
  const lines = text.split("\n");
  const begins = (line) => lines.slice(0, line).reduce((sum, it) => sum + it.length + 1, 0);
  const offset = ({ line, character }) => Math.min(begins(line) + character, text.length);
  const place = ({ range, newText }) => [offset(range.start), offset(range.end), newText];
  const places = edits.map(place);
  for (const [start, end, newText] of places.sort((one, other) => other[0] - one[0])) {
    text = text.slice(0, start) + newText + text.slice(end);
  }
  return text;
}
