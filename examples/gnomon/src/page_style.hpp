#pragma once
// The page's style and its few lines of script. Light and dark follow the reader's system.

#include <string_view>

namespace gnomon::command {

inline constexpr std::string_view page_style = R"css(
:root { color-scheme: light dark; --ink: #1c2126; --soft: #5b6670; --line: #dde2e6; --paper: #fbfbf9; --card: #ffffff;
  --s0: #0b6e4f; --s1: #7a3fb5; --s2: #b5482a; --s3: #1c6aa8; --s4: #8a6d00; --s5: #5b6670; }
@media (prefers-color-scheme: dark) { :root { --ink: #e7eaec; --soft: #9aa5ae; --line: #333a41; --paper: #15181b;
  --card: #1d2125; --s0: #4fc79a; --s1: #c09af0; --s2: #f08a6c; --s3: #70b7ee; --s4: #d9bc4a; --s5: #9aa5ae; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.55 system-ui, "Segoe UI", Roboto, sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 40px 24px 72px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 6px; font-weight: 650; letter-spacing: -0.01em; overflow-wrap: anywhere; }
h2 { font-size: 20px; margin: 48px 0 12px; font-weight: 650; }
h3 { font-size: 16px; margin: 0; font-weight: 650; overflow-wrap: anywhere; }
p { max-width: 78ch; margin: 0 0 12px; text-wrap: pretty; }
.lead { font-size: 18px; color: var(--soft); margin-bottom: 24px; }
.soft { color: var(--soft); font-size: 14px; }
code { font: 13px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
pre { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 12px 14px; overflow-x: auto; margin: 0; white-space: pre-wrap; }
.top { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 28px; align-items: start; }
figure { margin: 0; }
.debug { margin: 0 0 28px; }
figcaption { color: var(--soft); font-size: 14px; margin-top: 6px; }
img { display: block; width: 100%; height: auto; border-radius: 6px; cursor: zoom-in; background: var(--line); }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 6px 16px; margin: 0; font-size: 14px; }
dt { color: var(--soft); }
dd { margin: 0; }
.word { display: inline-block; max-width: 100%; overflow-wrap: anywhere; }
.wide { overflow-x: auto; margin-bottom: 14px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; font-variant-numeric: tabular-nums; }
th, td { padding: 8px 10px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { font-weight: 600; color: var(--soft); border-bottom-color: var(--soft); vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
td:first-child { font-weight: 600; white-space: normal; }
.swatch { display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 7px; vertical-align: -1px; }
.lit { background: var(--lit); } .shadow { background: var(--shadow); }
.legend { display: flex; flex-wrap: wrap; gap: 8px 28px; list-style: none; padding: 0; margin: 0 0 20px; font-size: 14px; }
.plot { width: 100%; height: auto; max-width: 920px; display: block; font: 12px system-ui, sans-serif; }
.plot text { fill: var(--ink); } .plot .tick { fill: var(--soft); } .plot .axis { fill: var(--soft); }
.plot .label { font-weight: 600; paint-order: stroke; stroke: var(--paper); stroke-width: 4px; stroke-linejoin: round; }
.plot .grid { stroke: var(--line); } .plot .frame { fill: none; stroke: var(--soft); stroke-opacity: 0.5; }
.plot .strip { fill: var(--soft); fill-opacity: 0.09; } .plot .mark { stroke: var(--soft); }
.plot .ray { stroke: var(--soft); stroke-dasharray: 3 4; }
.plot .line { fill: none; stroke: var(--c); stroke-width: 2; stroke-opacity: 0.5; }
.plot .dot { fill: var(--c); stroke: var(--paper); stroke-width: 2; }
.s0 { --c: var(--s0); } .s1 { --c: var(--s1); } .s2 { --c: var(--s2); } .s3 { --c: var(--s3); } .s4 { --c: var(--s4); } .s5 { --c: var(--s5); }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 480px), 1fr)); gap: 28px; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 16px; }
.card header { display: flex; justify-content: space-between; gap: 12px; align-items: baseline; margin-bottom: 12px; flex-wrap: wrap; }
.card .figures { font-size: 14px; margin: 12px 0 0; }
.flip { position: relative; }
.flip img + img { position: absolute; inset: 0; visibility: hidden; }
.card:has(.show-wrong:checked) .flip img + img { visibility: visible; }
.choice { display: inline-flex; border: 1px solid var(--line); border-radius: 999px; overflow: hidden; font-size: 13px; }
.choice input { position: absolute; opacity: 0; pointer-events: none; }
.choice label { padding: 3px 12px; cursor: pointer; color: var(--soft); }
.choice input:checked + label { background: var(--ink); color: var(--paper); }
.choice input:focus-visible + label { outline: 2px solid var(--s3); outline-offset: -2px; }
details { margin-top: 10px; font-size: 14px; } summary { cursor: pointer; color: var(--soft); }
details dl { margin-top: 8px; }
dialog { border: 0; padding: 0; background: #000; max-width: 100vw; max-height: 100vh; overflow: auto; }
dialog img { width: auto; max-width: none; border-radius: 0; cursor: zoom-out; }
dialog::backdrop { background: rgb(0 0 0 / 0.8); }
footer { margin-top: 56px; border-top: 1px solid var(--line); padding-top: 16px; }
@media (max-width: 760px) { .top { grid-template-columns: 1fr; } main { padding: 24px 16px 48px; } }
)css";

/// A click on a picture shows it pixel for pixel; the page is whole without it.
inline constexpr std::string_view page_script = R"js(
const box = document.querySelector('dialog'), full = box.querySelector('img');
for (const img of document.querySelectorAll('figure img, .flip img'))
  img.addEventListener('click', () => { full.src = img.src; full.alt = img.alt; box.showModal(); });
box.addEventListener('click', () => box.close());
for (const all of document.querySelectorAll('[data-all]'))
  all.addEventListener('change', () => document.querySelectorAll('.card .' + all.dataset.all).forEach(r => r.checked = true));
)js";

}  // namespace gnomon::command
