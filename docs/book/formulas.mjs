// Sets the formulas of pages as MathML: FOLDER TOOLS. Blocks of the language `math` are replaced; above LaTeX that the
// command printed its equations are shown; in tables, formulas are written as GitHub reads them, between $` and `$. A
// formula that Temml cannot read is an error.
import { readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, tools] = process.argv.slice(2);
const { default: temml } = await import(pathToFileURL(join(tools, "node_modules/temml/dist/temml.mjs")));

const pages = (path) =>
    statSync(path).isDirectory() ? readdirSync(path).flatMap((name) => pages(join(path, name))) : path.endsWith(".md") ? [path] : [];

let count = 0;
const set = (latex) => {
    count += 1;
    // Temml leaves no space between a factor and a function behind it.
    latex = latex.replace(/(?<=[\w})]) (?=\\(?:sin|cos)\b)/g, " \\, ");
    const options = { displayMode: true, throwOnError: true, strict: true };
    return `<div class="formula">${temml.renderToString(latex.trim(), options).replace(/\s*\n\s*/g, " ")}</div>\n`;
};

// Each display of printed LaTeX, without the comments between them, which are its headings.
const printed = (latex) =>
    [...latex.matchAll(/(?:^% (.*)\n)?(\\begin\{(align\*?)\}[^]*?\\end\{\3\})/gm)].map(([, heading, display]) =>
        (heading ? `\n*${heading}*\n\n` : "") + set(display.replaceAll("{align}", "{align*}").replace(/\\label\{[^}]*\}/g, ""))).join("\n");

// Formulas between $` and `$ in a row of a table; a bar would end the cell.
const inline = (row) =>
    row.replace(/\$`([^`]+)`\$/g, (_, latex) => {
        count += 1;
        return temml.renderToString(latex, { throwOnError: true, strict: true }).replace(/\s*\n\s*/g, " ").replaceAll("|", "&#124;");
    });

for (const page of pages(folder)) {
    const text = readFileSync(page, "utf8");
    const shown = text
        .replace(/^```latex output\n([^]*?)^```$/gm, (block, latex) =>
            latex.includes("…") ? block : `${printed(latex)}\n<details><summary>LaTeX</summary>\n\n${block}\n\n</details>`)
        .replace(/^\| .*$/gm, inline)
        .replace(/^```math\n([^]*?)^```$/gm, (_, latex) => set(latex));
    if (shown !== text) writeFileSync(page, shown);
}
console.log(`${count} formulas`);
