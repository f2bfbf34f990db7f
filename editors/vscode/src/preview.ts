// The panel with the drawn start: it follows the text and the cursor.

import { randomBytes } from "node:crypto";
import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { debounced } from "./debounce";
import { type PreviewAnswer, page, shownOf } from "./picture";

/** How long after the last key or move the start is drawn, in milliseconds. */
const DELAY = 150;

/** The panel, if it is open. */
export class Preview implements vscode.Disposable {
  readonly #client: () => LanguageClient | undefined;
  readonly #follow = debounced(() => void this.#draw(), DELAY);
  readonly #listeners: vscode.Disposable;
  #panel: vscode.WebviewPanel | undefined;
  /** The text that is drawn: the last one of the language that had the cursor. */
  #editor: vscode.TextEditor | undefined;
  /** Counts the questions, so that an answer that comes too late is dropped. */
  #asked = 0;

  constructor(client: () => LanguageClient | undefined) {
    this.#client = client;
    this.#listeners = vscode.Disposable.from(
      vscode.window.onDidChangeActiveTextEditor((editor) => this.#look(editor)),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.#look(textEditor)),
      vscode.workspace.onDidChangeTextDocument(({ document }) => {
        // A file that the text imports may change what is drawn, too.
        if (document.languageId === "pitch") this.#follow();
      }),
    );
  }

  /** Opens the panel beside the text, or shows it again. */
  open(): void {
    this.#editor = vscode.window.activeTextEditor;
    if (this.#panel) {
      this.#panel.reveal(undefined, true);
    } else {
      const place = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
      const rights = { enableScripts: true, localResourceRoots: [] };
      const options = { ...rights, retainContextWhenHidden: true };
      this.#panel = vscode.window.createWebviewPanel("setpiece.preview", "Start", place, options);
      this.#panel.webview.html = page(randomBytes(16).toString("base64url"));
      this.#panel.onDidDispose(() => {
        this.#panel = undefined;
        this.#follow.cancel();
      });
    }
    this.#follow();
  }

  dispose(): void {
    this.#follow.cancel();
    this.#listeners.dispose();
    this.#panel?.dispose();
  }

  #look(editor: vscode.TextEditor | undefined): void {
    if (editor?.document.languageId !== "pitch") return;
    this.#editor = editor;
    this.#follow();
  }

  async #draw(): Promise<void> {
    const [panel, editor, client] = [this.#panel, this.#editor, this.#client()];
    if (!panel || !editor || !client) return;
    this.#asked += 1;
    const asked = this.#asked;
    const { line, character } = editor.selection.active;
    const question = {
      textDocument: { uri: client.code2ProtocolConverter.asUri(editor.document.uri) },
      position: { line, character },
    };
    let answer: PreviewAnswer | null;
    try {
      answer = await client.sendRequest<PreviewAnswer | null>("setpiece/preview", question);
    } catch (why) {
      answer = { message: why instanceof Error ? why.message : String(why) };
    }
    if (asked !== this.#asked || panel !== this.#panel) return;
    const shown = shownOf(answer);
    panel.title = shown.title ? `Start of ${shown.title}` : "Start";
    await panel.webview.postMessage(shown);
  }
}
