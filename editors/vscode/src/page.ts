// The panel's page.

/** The page's script, bundled from `panel.ts`. */
declare const PANEL: string;

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
#field { position: relative; touch-action: none; user-select: none; }
#field.near { cursor: grab; }
#field.held { cursor: grabbing; }
img { display: block; width: 100%; height: auto; }
img.stale { opacity: 0.4; }
#things button, #ghost {
  position: absolute; box-sizing: border-box; aspect-ratio: 1; padding: 0; border: none;
  border-radius: 50%; background: none; pointer-events: none; transform: translate(-50%, -50%);
}
#things button:focus-visible { outline: 2px solid var(--vscode-focusBorder, #ffffff); }
#ghost { border: 2px dashed #ffffff; background: #ffffff55; }
p { white-space: pre-wrap; color: var(--vscode-descriptionForeground); }
ul { list-style: none; margin: 0; padding: 0; }
[hidden] { display: none !important; }
</style>
</head>
<body>
<h1 id="title"></h1>
<div id="field">
<img id="picture" alt="The start, seen from above" draggable="false" hidden>
<div id="things" role="group" aria-label="Players and the ball: arrow keys move, Enter drops"></div>
<div id="ghost" hidden></div>
</div>
<p id="words" role="status"></p>
<ul id="asked" aria-label="What a start must meet"></ul>
<script nonce="${nonce}">
${PANEL}</script>
</body>
</html>
`;
}
