// The panel with the drawn start: it follows the text and the cursor, and what is dragged in it
// changes the text.

import { randomBytes } from "node:crypto";
import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { debounced } from "./debounce";
import { type Drawn, type MoveAnswer, CHANGED, editsOf, isDrop, questionOf } from "./move";
import { page } from "./page";
import { type PageMessage, type PreviewAnswer, shownOf } from "./picture";

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
  /** What the picture shows. */
  #drawn: (Drawn & { readonly document: vscode.TextDocument }) | undefined;
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
      this.#panel.webview.onDidReceiveMessage((message) => void this.#hear(message));
      this.#panel.onDidDispose(() => {
        this.#panel = this.#drawn = undefined;
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
    const { document } = editor;
    const { line, character } = editor.selection.active;
    const uri = client.code2ProtocolConverter.asUri(document.uri);
    const question = { textDocument: { uri }, position: { line, character } };
    let answer: PreviewAnswer | null;
    try {
      answer = await client.sendRequest<PreviewAnswer | null>("setpiece/preview", question);
    } catch (why) {
      answer = { message: why instanceof Error ? why.message : String(why) };
    }
    if (asked !== this.#asked || panel !== this.#panel) return;
    const { scenario, version } = answer ?? {};
    const drawing = asked;
    this.#drawn = scenario && version ? { drawing, uri, version, scenario, document } : undefined;
    const shown = shownOf(answer, drawing);
    panel.title = shown.title ? `Start of ${shown.title}` : "Start";
    await panel.webview.postMessage(shown);
  }

  /** What the page says: something was dropped in the picture. */
  async #hear(message: unknown): Promise<void> {
    if (!isDrop(message)) return;
    const [panel, drawn, client] = [this.#panel, this.#drawn, this.#client()];
    const question = questionOf(drawn, message);
    const refused = drawn && question && client
      ? await this.#move(client, drawn.document, question)
      : CHANGED;
    if (!refused) return;
    const answer: PageMessage = { refused };
    await panel?.webview.postMessage(answer);
  }

  /** Moves something in a text; why not, if it can't be. */
  async #move(
    client: LanguageClient,
    document: vscode.TextDocument,
    question: object,
  ): Promise<string | undefined> {
    try {
      const answer = await client.sendRequest<MoveAnswer | null>("setpiece/move", question);
      const planned = editsOf(answer, document.version);
      if ("refused" in planned) return planned.refused;
      const edit = new vscode.WorkspaceEdit();
      for (const { range, newText } of planned.edits) {
        edit.replace(document.uri, client.protocol2CodeConverter.asRange(range), newText);
      }
      return (await vscode.workspace.applyEdit(edit)) ? undefined : CHANGED;
    } catch (why) {
      return why instanceof Error ? why.message : String(why);
    }
  }
}
