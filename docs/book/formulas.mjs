// Sets the formulas of pages as MathML: FOLDER TOOLS. Blocks of the language `math` are replaced; above LaTeX that the
// command printed its equations are shown; in tables, terms in infix text such as `-qd2^2*l5*cos(q2)` are formulas. A
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
    latex = latex.replace(/(?<=[\w})]) (?=\\(?:sin|cos) )/g, " \\, ");
    const options = { displayMode: true, throwOnError: true, strict: true };
    return `<div class="formula">${temml.renderToString(latex.trim(), options).replace(/\s*\n\s*/g, " ")}</div>\n`;
};

// Each display of printed LaTeX, without the comments between them, which are its headings.
const printed = (latex) =>
    [...latex.matchAll(/(?:^% (.*)\n)?(\\begin\{(align\*?)\}[^]*?\\end\{\3\})/gm)].map(([, heading, display]) =>
        (heading ? `\n*${heading}*\n\n` : "") + set(display.replaceAll("{align}", "{align*}").replace(/\\label\{[^}]*\}/g, ""))).join("\n");

// A product of symbols of the paper, of sines and of cosines as LaTeX; undefined if the text is something else.
const symbol = (name) => {
    const rules = [
        [/^q(d{0,2})(\d)$/, (dots, joint) => ["q", "\\dot{q}", "\\ddot{q}"][dots.length] + `_${joint}`],
        [/^([lM])(\d)$/, (letter, link) => `${letter}_${link}`],
        [/^J([xyz])(\d)$/, (axis, link) => `J_${axis}^{*${link}}`],
        [/^([FM])(?:_l)?([xyz]?)(\d)(?:\.([xyz]))?$/, (letter, axis, link, other) => axis || other ? `${letter}_{l_${axis || other}}^{${link}}` : undefined],
    ];
    for (const [pattern, latex] of rules) {
        const parts = pattern.exec(name);
        if (parts) return latex(...parts.slice(1));
    }
};
const product = (text) => {
    const [, sign, factors] = /^(-?)(.*)$/.exec(text);
    const all = factors.split("*").map((factor) => {
        const [, , called, name, , power] = /^((sin|cos)\((\w+)\)|[\w.]+)(\^(\d))?$/.exec(factor) ?? [];
        const exponent = power ? `^${power}` : "";
        if (called) return symbol(name) && `\\${called}${exponent} ${symbol(name)}`;
        const plain = symbol(factor.replace(/\^\d$/, ""));
        return plain && !(power && plain.includes("^")) ? plain + exponent : undefined;
    });
    return all.includes(undefined) ? undefined : sign + all.join(" \\, ");
};
const inline = (row) =>
    row.replace(/`([^`|]+)`/g, (code, text) => {
        const latex = product(text);
        if (latex === undefined) return code;
        count += 1;
        return temml.renderToString(latex, { throwOnError: true, strict: true }).replace(/\s*\n\s*/g, " ");
    });

for (const page of pages(folder)) {
    const text = readFileSync(page, "utf8");
    const shown = text
        .replace(/^```latex output\n([^]*?)^```$/gm, (block, latex) =>
            latex.includes("…") ? block : `${printed(latex)}\n<details><summary>LaTeX</summary>\n\n${block}\n\n</details>`)
        .replace(/^\| \(\d+\) .*$/gm, inline)
        .replace(/^```math\n([^]*?)^```$/gm, (_, latex) => set(latex));
    if (shown !== text) writeFileSync(page, shown);
}
console.log(`${count} formulas`);
