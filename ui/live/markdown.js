// Markdown as this program writes it, to HTML: paragraphs, lists, tables, bold, code, badges, small words, LaTeX.

const TAGS = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
const INLINE = [
  [/\*\*(.+?)\*\*/g, "<strong>$1</strong>"],
  [/`(.+?)`/g, "<code>$1</code>"],
  [/:(\w+)-badge\[(.+?)\]/g, '<span class="stMarkdownBadge live-$1" style="font-size: 0.875rem">$2</span>'],
  [/:small\[(.+)\]/g, '<span style="font-size: 0.875rem">$1</span>'],
];

// The page's style is for an older KaTeX than its script, whose parts' classes have no prefix.
function equation(tex, katex, displayMode = false) {
  const html = katex.renderToString(tex, { displayMode, throwOnError: false });
  return html.replace(/\bkatex-(?!html|mathml|display|error)/g, "");
}

function inline(text, katex) {
  return text.split(/(\$[^$]+\$)/).map((part) => {
    if (part.startsWith("$") && part.length > 1) return equation(part.slice(1, -1), katex);
    const safe = part.replace(/[&<>"]/g, (sign) => TAGS[sign]);
    return INLINE.reduce((words, [pattern, html]) => words.replace(pattern, html), safe);
  }).join("");
}

function table(lines, katex) {
  const rows = lines.map((line) => line.split("|").slice(1, -1).map((cell) => cell.trim()));
  const sides = rows[1].map((rule) => (rule.endsWith(":") ? "right" : "left"));
  const row = (cells, tag) => `<tr>${cells.map(
    (cell, i) => `<${tag} style="text-align: ${sides[i]}">${inline(cell, katex)}</${tag}>`).join("")}</tr>`;
  return `<table><thead>${row(rows[0], "th")}</thead><tbody>${
    rows.slice(2).map((cells) => row(cells, "td")).join("")}</tbody></table>`;
}

function block(text, katex) {
  const lines = text.split("\n");
  if (text.startsWith("$$"))
    return `<p>${equation(text.replaceAll("$$", ""), katex, true)}</p>`;
  if (text.startsWith("|")) return table(lines, katex);
  if (lines.every((line) => /^(- |  )/.test(line)))
    return `<ul>${text.split(/^- /m).slice(1).map((item) => `<li>${inline(item, katex)}</li>`).join("")}</ul>`;
  return `<p>${inline(text, katex)}</p>`;
}

export function html(markdown, katex) {
  return markdown.trim().split(/\n\s*\n/).map((part) => block(part.trim(), katex)).join("\n");
}
