// The text, with the reports beside their lines.
//
// The session's check gives it problems through `report`; completion, hover, fixes and the rest come
// from the language server.

import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { Compartment, EditorState, Transaction } from "@codemirror/state";
import { EditorView, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { Language } from "./language";
import type { Label, Problem } from "./messages";

/** For how many problems fixes are looked for. */
const OFFERED = 10;

const WORDS = new Set(
  ("scenario abstract extends reward behavior formation region ending const fn import param let " +
    "state record observe ball team left right at ahead behind of by between beyond offset from " +
    "along facing jitter require with when else on give once as end success failure limit agents " +
    "rules world pitch start mirror do until for repeat times choose interrupt finish if then and or not in " +
    "each absent remove script kickoff rounds substitute table grid maybe noise delayed stack count " +
    "max min mean sum first last series has completed " +
    "true false nobody none").split(" "),
);

const pitch = StreamLanguage.define<{ comment: boolean }>({
  startState: () => ({ comment: false }),
  token(stream, state) {
    if (state.comment || stream.match("/*")) {
      state.comment = !stream.match(/^.*?\*\//);
      if (state.comment) stream.skipToEnd();
      return "comment";
    }
    if (stream.match(/^\/\/.*/)) return "comment";
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) return "string";
    if (stream.match(/^\d+(\.\d+)?([eE][-+]?\d+)?(m\/s|km\/h|ms|m|s|deg|rad|%)?/)) return "number";
    const word = stream.match(/^[A-Za-z_]\w*/) as RegExpMatchArray | null;
    if (word) {
      if (/^(GK|CB|LB|RB|DM|CM|LM|RM|AM|CF)$/.test(word[0])) return "typeName";
      return WORDS.has(word[0]) ? "keyword" : "variableName";
    }
    stream.next();
    return null;
  },
});

const colours = HighlightStyle.define([
  { tag: tags.keyword, color: "var(--keyword)" },
  { tag: tags.comment, color: "var(--faint)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--string)" },
  { tag: tags.number, color: "var(--number)" },
  { tag: tags.typeName, color: "var(--role)", fontWeight: "600" },
]);

export class Editor {
  private readonly view: EditorView;
  private readonly language = new Language();
  private readonly served = new Compartment();
  private address = "";
  private reports = 0;
  private quiet = false;

  constructor(parent: HTMLElement, changed: (text: string) => void, save: () => void) {
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        extensions: [
          lineNumbers(),
          history(),
          pitch,
          syntaxHighlighting(colours),
          lintGutter(),
          this.served.of([]),
          EditorView.lineWrapping,
          keymap.of([
            { key: "Mod-s", run: () => (save(), true), preventDefault: true },
            indentWithTab,
            ...defaultKeymap,
            ...historyKeymap,
          ]),
          EditorView.updateListener.of((update) => {
            if (update.docChanged && !this.quiet) changed(this.text());
          }),
          EditorView.contentAttributes.of({
            "aria-label": "Scenario text. Escape, then Tab leaves it.",
          }),
        ],
      }),
    });
  }

  /** Serves the text under an address, by which its imports are found. */
  async serve(address: string): Promise<void> {
    if (address === this.address) return;
    this.address = address;
    const extension = await this.language.open(address);
    this.view.dispatch({ effects: this.served.reconfigure(extension) });
  }

  text(): string {
    return this.view.state.doc.toString();
  }

  /**
   * Shows another text; what is alike stays, so that the cursor does.
   *
   * `undoable`: whether undo takes it back. What comes from elsewhere stays.
   */
  show(text: string, undoable: boolean): void {
    const old = this.text();
    if (old === text) return;
    let from = 0;
    const least = Math.min(old.length, text.length);
    while (from < least && old[from] === text[from]) from++;
    let tail = 0;
    while (tail < least - from && old[old.length - 1 - tail] === text[text.length - 1 - tail]) tail++;
    this.quiet = true;
    const insert = text.slice(from, text.length - tail);
    const annotations = Transaction.addToHistory.of(undoable);
    this.view.dispatch({ changes: { from, to: old.length - tail, insert }, annotations });
    this.quiet = false;
  }

  /** Puts the cursor on a line. */
  go(line: number): void {
    const at = this.view.state.doc.line(Math.min(Math.max(line, 1), this.view.state.doc.lines));
    this.view.dispatch({ selection: { anchor: at.from, head: at.to }, scrollIntoView: true });
    this.view.focus();
  }

  report(problems: Problem[]): void {
    const shown = problems.map((problem): Diagnostic => {
      const [from, to] = this.range(problem.labels[0]);
      const help = problem.help ? `\n${problem.help}` : "";
      return {
        from,
        to,
        severity: problem.severity === "warning" ? "warning" : "error",
        message: `${problem.code}: ${problem.message}${help}`,
      };
    });
    this.view.dispatch(setDiagnostics(this.view.state, shown));
    void this.offer(shown);
  }

  /** Adds what mends the problems, once the server has tried it. */
  private async offer(shown: Diagnostic[]): Promise<void> {
    const report = ++this.reports;
    const text = this.view.state.doc;
    for (const problem of shown.slice(0, OFFERED)) {
      const fixes = await this.language.fixes(this.view, problem.from, problem.to).catch(() => []);
      // Another check has come meanwhile.
      if (report !== this.reports || !this.view.state.doc.eq(text)) return;
      problem.actions = fixes.map((fix) => ({ name: fix.title, apply: fix.apply }));
    }
    if (shown.some((problem) => problem.actions?.length)) {
      this.view.dispatch(setDiagnostics(this.view.state, shown));
    }
  }

  private range(label: Label | undefined): [number, number] {
    const doc = this.view.state.doc;
    const offset = (line: number, column: number): number => {
      const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
      // Columns count characters, the editor counts UTF-16 units.
      const before = [...at.text].slice(0, column - 1).join("").length;
      return Math.min(at.from + before, at.to);
    };
    if (!label) return [0, 0];
    const from = offset(label.line, label.column);
    return [from, Math.max(from, offset(label.end_line, label.end_column))];
  }
}
