// What the server draws, and what the panel shows of it.

/** The answer to `setpiece/preview`. */
export interface PreviewAnswer {
  /** The scenario at the place that was asked about. */
  readonly scenario?: string | null;
  /** Its start. */
  readonly svg?: string | null;
  /** Why nothing is drawn. */
  readonly message?: string | null;
}

/** What the panel's page is sent. */
export interface Shown {
  readonly title: string;
  /** The address of the picture; the last one stays if absent. */
  readonly picture?: string;
  /** Words beneath it; may be empty. */
  readonly words: string;
}

/** What is shown of an answer. As an image, a drawing can run nothing and load nothing. */
export function shownOf(answer: PreviewAnswer | null | undefined): Shown {
  const title = answer?.scenario ?? "";
  const words = answer?.message ?? "";
  if (!answer?.svg) return { title, words: words || "No scenario stands here." };
  const encoded = Buffer.from(answer.svg, "utf8").toString("base64");
  return { title, picture: `data:image/svg+xml;base64,${encoded}`, words };
}

/** The panel's page. Only its own style and script may run, and only pictures in it are shown. */
export function page(nonce: string): string {
  const policy = [
    "default-src 'none'",
    "img-src data:",
    `style-src 'nonce-${nonce}'`,
    `script-src 'nonce-${nonce}'`,
  ].join("; ");
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Setpiece</title>
<style nonce="${nonce}">
body { margin: 0; padding: 0.5rem; color: var(--vscode-foreground); }
h1 { font-size: 1rem; font-weight: 600; margin: 0 0 0.5rem; }
img { width: 100%; height: auto; }
img.stale { opacity: 0.4; }
p { white-space: pre-wrap; color: var(--vscode-descriptionForeground); }
[hidden] { display: none; }
</style>
</head>
<body>
<h1 id="title"></h1>
<img id="picture" alt="The start, seen from above" hidden>
<p id="words" role="status"></p>
<script nonce="${nonce}">
const part = (id) => document.getElementById(id);
const [title, picture, words] = [part("title"), part("picture"), part("words")];
window.addEventListener("message", ({ data }) => {
  title.textContent = data.title;
  words.textContent = data.words;
  picture.classList.toggle("stale", !data.picture);
  if (data.picture) {
    picture.src = data.picture;
    picture.hidden = false;
  }
});
</script>
</body>
</html>
`;
}
