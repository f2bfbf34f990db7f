// The text's language server: the one of `setpiece lsp`, over a socket of its own.

import type { Extension } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";
import {
  LSPClient,
  formatKeymap,
  hoverTooltips,
  jumpToDefinitionKeymap,
  renameKeymap,
  serverCompletion,
  signatureHelp,
} from "@codemirror/lsp-client";
import { keymap } from "@codemirror/view";

/** A change that mends a problem: what it does, and the text with it. */
export interface Fix { title: string; apply: (view: EditorView) => void }

interface Place { line: number; character: number }
interface TextEdit { range: { start: Place; end: Place }; newText: string }
interface CodeAction { title: string; kind: string; edit?: { changes?: Record<string, TextEdit[]> } }

export class Language {
  private client: LSPClient | null = null;
  private uri = "";

  /** Connects, and gives what the editor needs for the text of this address. */
  open(uri: string): Promise<Extension> {
    this.uri = uri;
    const token = new URLSearchParams(location.search).get("token") ?? "";
    const socket = new WebSocket(`ws://${location.host}/language?token=${token}`);
    const hearers = new Set<(message: string) => void>();
    socket.onmessage = (event) => hearers.forEach((hear) => hear(String(event.data)));
    const client = new LSPClient({
      timeout: 10_000,
      extensions: [
        serverCompletion(),
        hoverTooltips(),
        signatureHelp(),
        keymap.of([...formatKeymap, ...renameKeymap, ...jumpToDefinitionKeymap]),
      ],
    });
    return new Promise((resolve) => {
      socket.onopen = () => {
        client.connect({
          send: (message) => socket.send(message),
          subscribe: (hear) => hearers.add(hear),
          unsubscribe: (hear) => hearers.delete(hear),
        });
        this.client = client;
        resolve(client.plugin(uri, "pitch"));
      };
      socket.onclose = () => client.disconnect();
    });
  }

  /** What mends the problem between two places of the text. */
  async fixes(view: EditorView, from: number, to: number): Promise<Fix[]> {
    const client = this.client;
    if (!client) return [];
    await client.initializing;
    client.sync();
    const place = (at: number): Place => {
      const line = view.state.doc.lineAt(at);
      return { line: line.number - 1, character: at - line.from };
    };
    const offset = (at: Place): number => {
      const line = view.state.doc.line(Math.min(at.line + 1, view.state.doc.lines));
      return Math.min(line.from + at.character, line.to);
    };
    const asked = {
      textDocument: { uri: this.uri },
      range: { start: place(from), end: place(to) },
      context: { diagnostics: [] },
    };
    const found = await client.request<typeof asked, CodeAction[] | null>("textDocument/codeAction", asked);
    const text = view.state.doc;
    return (found ?? []).filter((action) => action.kind === "quickfix").map((action) => ({
      title: action.title,
      apply: (target) => {
        // A text that has changed since has the places elsewhere.
        if (!target.state.doc.eq(text)) return;
        const edits = action.edit?.changes?.[this.uri] ?? [];
        const changes = edits.map((edit) => ({
          from: offset(edit.range.start), to: offset(edit.range.end), insert: edit.newText,
        }));
        target.dispatch({ changes });
      },
    }));
  }
}
