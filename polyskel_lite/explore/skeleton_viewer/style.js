// How the viewer looks on a page, in JupyterLab and in print.

export const STYLE = `
.psl { --psl-line: color-mix(in srgb, currentColor 28%, transparent);
  color: var(--pst-color-text-base, var(--jp-content-font-color1, inherit));
  font-family: inherit; font-size: 0.9rem; line-height: 1.4; margin: 0.6rem 0; }
html[data-theme="dark"] .bd-content div.cell_output .text_html:has(.psl) { background: transparent !important; }
.psl * { box-sizing: border-box; }
.psl p { margin: 0.35rem 0; }
.psl-look { font-weight: 600; }
.psl-stage { position: relative; width: 100%; border: 1px solid var(--psl-line);
  border-radius: 6px; overflow: hidden; }
.psl-stage canvas { display: block; width: 100%; height: 100%; touch-action: pan-y; cursor: grab; outline: none; }
.psl-stage canvas:active { cursor: grabbing; }
.psl-stage:focus-within, .psl input:focus-visible, .psl select:focus-visible, .psl button:focus-visible,
.psl summary:focus-visible {
  outline: 3px solid #0072b2; outline-offset: 2px; }
html[data-theme="dark"] .psl :focus-visible, html[data-theme="dark"] .psl-stage:focus-within,
[data-jp-theme-light="false"] .psl :focus-visible { outline-color: #8fd0ff; }
.psl-status { font-variant-numeric: tabular-nums; min-height: 2.8em; }
.psl-grid { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 19rem), 1fr));
  gap: 0.35rem 1.6rem; align-items: center; }
.psl-row { display: grid; grid-template-columns: 7.5rem 1fr auto; gap: 0.6rem; align-items: center; min-height: 2rem; }
.psl-wide { grid-column: 1 / -1; }
.psl-row input[type="range"] { width: 100%; min-width: 0; margin: 0; accent-color: #0072b2; height: 1.5rem; }
.psl-row output { min-width: 4.6rem; text-align: right; font-variant-numeric: tabular-nums; }
.psl-row input[type="text"] { width: 5rem; }
.psl input[type="text"][aria-invalid="true"] { border: 2px solid #b3261e; }
html[data-theme="dark"] .psl input[aria-invalid="true"], [data-jp-theme-light="false"] .psl input[aria-invalid="true"] {
  border-color: #ff8a80; }
.psl-problem { grid-column: 2 / -1; font-weight: 600; }
.psl .psl-problem:empty { margin: -0.6rem 0 0; }
/* A tick stands under the middle of the slider's thumb, which is 16 pixels wide. */
.psl-ticks { grid-column: 2; position: relative; height: 1.9rem; margin-top: -0.5rem; }
.psl .psl-ticks button { position: absolute; left: calc(var(--at) * (100% - 16px) + 8px); transform: translateX(-50%);
  min-height: 1.7rem; min-width: 1.5rem; padding: 0.25rem 0.15rem 0; border: 0; font-size: 0.8rem; line-height: 1.2; }
.psl-ticks button::before { content: ""; position: absolute; left: 50%; top: 0; height: 0.35rem; border-left: 1.5px solid currentColor; }
.psl-ticks button[aria-pressed="true"] { font-weight: 700; text-decoration: underline; }
.psl summary { cursor: pointer; min-height: 2rem; padding: 0.3rem 0; width: fit-content; }
.psl input[type="text"], .psl select, .psl button { font: inherit; color: inherit; background: transparent;
  border: 1px solid color-mix(in srgb, currentColor 55%, transparent); border-radius: 4px; padding: 0.15rem 0.45rem; }
.psl select option { color: #000; background: #fff; }
.psl button { cursor: pointer; min-height: 2rem; padding: 0.15rem 0.7rem; }
.psl button:hover { background: color-mix(in srgb, currentColor 12%, transparent); }
.psl fieldset { border: 0; margin: 0; padding: 0; display: flex; flex-wrap: wrap; gap: 0.2rem 1rem;
  align-items: center; min-height: 2rem; min-inline-size: 0; }
.psl legend { float: left; padding: 0; margin: 0 0.6rem 0 0; font-size: inherit; width: 7.5rem; }
.psl fieldset label { display: inline-flex; gap: 0.35rem; align-items: center; margin: 0; min-height: 1.6rem; }
.psl-bar { display: flex; flex-wrap: wrap; gap: 0.4rem 0.5rem; align-items: center; }
.psl-hint { font-size: 0.8rem; opacity: 0.85; }
.psl-only-heard { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%);
  white-space: nowrap; }
@media (max-width: 30rem) { .psl-row { grid-template-columns: 1fr auto; } .psl-row > label { grid-column: 1 / -1; }
  .psl-row:has(.psl-ticks) > label { grid-column: 1; } .psl-row:has(.psl-ticks) > span { grid-area: 1 / 2; }
  .psl-row:has(.psl-ticks) > input, .psl-ticks, .psl-problem { grid-column: 1 / -1; }
  .psl legend { width: 100%; float: none; } }
@media print { .psl-controls, .psl-hint { display: none; } }
`;
