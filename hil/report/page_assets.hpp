// Style sheet and script of the report page. The script only adds the read-out under the pointer.
// It reads the values back from the plots, so that no number is in the page twice.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace pitwall::report {

// Style of what Plot draws, inside a page or in a separate SVG file.
inline constexpr std::string_view kPlotStyle = R"css(
svg { display: block; max-width: 100%; }
svg text { font: 12px "DejaVu Sans", Verdana, system-ui, sans-serif; fill: #3a454f; }
svg text.title { font-weight: bold; font-size: 13px; fill: #1b232b; }
svg text.symbol { fill: #fff; font-weight: bold; }
svg text.cut { fill: #1b232b; font-weight: bold; stroke: #fff; stroke-width: 3px;
  paint-order: stroke; }
svg text.piece { fill: #1b232b; }
svg text.read { font-weight: bold; fill: #1b232b; font-variant-numeric: tabular-nums;
  stroke: #fff; stroke-width: 5px; paint-order: stroke; }
.grid { stroke: #e3e8ec; fill: none; }
.frame { stroke: #66727e; fill: none; }
.cursor { stroke: #1b232b; stroke-dasharray: 2 2; pointer-events: none; }
.small .grid { stroke: #aab4bd; }
)css";

inline constexpr std::string_view kStyle = R"css(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 16px 20px 40px; max-width: 1248px; background: #fff; color: #1b232b;
  font: 14px/1.45 "DejaVu Sans", Verdana, system-ui, sans-serif; }
h1 { margin: 4px 0 8px; font-size: 24px; overflow-wrap: anywhere; }
h2 { margin: 28px 0 8px; padding-top: 6px; font-size: 17px; border-top: 2px solid #1b232b; }
.simulation { margin: 0; display: inline-block; padding: 2px 10px; font-weight: bold; color: #fff;
  background: #5b3a8c; letter-spacing: 0.03em; }
dl { display: flex; flex-wrap: wrap; gap: 6px 22px; margin: 0 0 12px; }
dt { font-size: 12px; color: #55606b; }
dd { margin: 0; overflow-wrap: anywhere; }
.figures dd { font-variant-numeric: tabular-nums; }
.banner { padding: 10px 14px; border-left: 10px solid; font-size: 16px; overflow-wrap: anywhere; }
.banner strong { font-size: 20px; margin-right: 10px; }
.banner p { margin: 4px 0 0; font-size: 14px; }
.pass { border-color: #00795a; background: #e3f4ed; }
.fail { border-color: #b3261e; background: #fdecea; }
.infrastructure { border-color: #6b4a00; background: #fff3d6; }
table { border-collapse: collapse; width: 100%; font-size: 13px;
  font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; color: #3a454f; border-bottom: 1px solid #66727e;
  padding: 4px 8px; vertical-align: bottom; }
td { padding: 3px 8px; border-bottom: 1px solid #e3e8ec; vertical-align: top; }
td.word { overflow-wrap: anywhere; }
.numbers td:not(.word), .numbers th:not(:nth-child(2)) { text-align: right; }
.numbers td:first-child, .numbers th:first-child { text-align: left; }
.messages td:nth-child(3), .messages th:nth-child(3) { text-align: left; }
.messages td { vertical-align: middle; padding-top: 1px; padding-bottom: 1px; }
.paper { color: #8a5700; }
.verdicts :is(th, td):is(:nth-child(3), :nth-child(4)) { white-space: nowrap; text-align: right; }
.held .state { color: #00684d; }
.broken { background: #fdecea; }
.broken .state { color: #a01a13; font-weight: bold; }
small { font-size: 12px; color: #55606b; }
.note, .legend { font-size: 13px; color: #3a454f; margin: 4px 0; }
.legend span { white-space: nowrap; margin-right: 10px; }
.legend i { display: inline-block; width: 18px; height: 10px; margin-right: 4px; }
.absent { margin: 8px 0; padding: 8px 12px; background: #f1f3f5; border-left: 4px solid #66727e;
  font-size: 13px; overflow-wrap: anywhere; }
.beside { display: grid; grid-template-columns: 592px minmax(0, 1fr); gap: 16px;
  align-items: start; }
@media print {
  body { max-width: none; padding: 0; print-color-adjust: exact; }
  section, svg, tr { break-inside: avoid; }
  svg { height: auto; }
}
@media (max-width: 1247px) { .beside { grid-template-columns: minmax(0, 1fr); } }
)css";

inline constexpr std::string_view kScript = R"js(
(() => {
  'use strict';
  const svgNode = (name, attributes, parent) => {
    const node = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const key in attributes) node.setAttribute(key, attributes[key]);
    return parent.appendChild(node);
  };
  const scaleOf = (svg) => {
    const d = svg.dataset, n = Number;
    const kx = (n(d.x1) - n(d.x0)) / (n(d.right) - n(d.left));
    const ky = (n(d.y1) - n(d.y0)) / (n(d.top) - n(d.bottom));
    return {
      x: (px) => n(d.x0) + (px - n(d.left)) * kx, px: (x) => n(d.left) + (x - n(d.x0)) / kx,
      y: (py) => n(d.y0) + (py - n(d.bottom)) * ky, py: (y) => n(d.bottom) + (y - n(d.y0)) / ky,
      left: n(d.left), right: n(d.right), top: n(d.top), bottom: n(d.bottom) };
  };
  const pointsOf = (path) => path.getAttribute('d').split(/(?=[ML])/).map((part) => {
    const [x, y] = part.slice(1).split(' ');
    return [Number(x), Number(y), part[0] === 'M'];
  });
  // The line at a pixel: between the two points around it, nothing in a gap.
  const valueAt = (points, px) => {
    let low = 0, high = points.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (points[middle][0] < px) low = middle + 1; else high = middle;
    }
    if (low >= points.length) return null;
    const after = points[low];
    if (after[0] === px || low === 0) return Math.abs(after[0] - px) < 1.5 ? after[1] : null;
    if (after[2]) return null;
    const before = points[low - 1];
    const share = (px - before[0]) / (after[0] - before[0] || 1);
    return before[1] + share * (after[1] - before[1]);
  };
  const digits = (value, span) =>
    value.toFixed(Math.max(0, Math.min(4, Math.ceil(2.3 - Math.log10(Math.abs(span))))));

  const charts = [...document.querySelectorAll('svg.time')].map((svg) => {
    const scale = scaleOf(svg);
    const lines = [...svg.querySelectorAll('path.mark[data-name]')].map((path) => ({
      name: path.dataset.name, unit: path.dataset.unit, points: pointsOf(path) }));
    const pieces = [...svg.querySelectorAll('g.mark[data-label]')].map((group) => {
      const box = group.querySelector('rect');
      const from = Number(box.getAttribute('x'));
      return { name: group.dataset.name, label: group.dataset.label, from,
        to: from + Number(box.getAttribute('width')) };
    });
    const cursor = svgNode('path', { class: 'cursor', visibility: 'hidden' }, svg);
    const read = svgNode('text',
      { class: 'read', x: scale.right, y: 19, 'text-anchor': 'end' }, svg);
    const show = (t) => {
      const px = scale.px(t);
      cursor.setAttribute('d', 'M' + px + ' ' + scale.top + 'V' + scale.bottom);
      cursor.setAttribute('visibility', 'visible');
      const words = [t.toFixed(2) + ' s'];
      const span = scale.y(scale.top) - scale.y(scale.bottom);
      for (const line of lines) {
        const py = valueAt(line.points, px);
        if (py !== null) words.push(line.name + ' ' + digits(scale.y(py), span) + ' ' + line.unit);
      }
      for (const piece of pieces)
        if (px >= piece.from && px <= piece.to) words.push(piece.label);
      read.textContent = words.join('   ');
    };
    const hide = () => { cursor.setAttribute('visibility', 'hidden'); read.textContent = ''; };
    return { svg, scale, show, hide };
  });

  const map = document.querySelector('svg[data-plot="map"]');
  const trace = JSON.parse((document.getElementById('trace') || { textContent: '[]' }).textContent);
  let dot = null, mapScale = null;
  if (map) {
    mapScale = scaleOf(map);
    dot = svgNode('circle', { r: 7, fill: 'none', stroke: '#1b232b', 'stroke-width': 3,
      visibility: 'hidden', 'pointer-events': 'none' }, map);
  }
  const showOnMap = (t) => {
    let best = -1;
    for (let i = 0; i < trace.length; i += 3)
      if (best < 0 || Math.abs(trace[i] - t) < Math.abs(trace[best] - t)) best = i;
    if (!dot || best < 0) return;
    dot.setAttribute('cx', mapScale.px(trace[best + 1]));
    dot.setAttribute('cy', mapScale.py(trace[best + 2]));
    dot.setAttribute('visibility', 'visible');
  };
  const showAll = (t) => { for (const chart of charts) chart.show(t); showOnMap(t); };
  const hideAll = () => {
    for (const chart of charts) chart.hide();
    if (dot) dot.setAttribute('visibility', 'hidden');
  };
  const placeIn = (svg, event) => {
    const box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
    return [(event.clientX - box.left) * view.width / box.width,
      (event.clientY - box.top) * view.height / box.height];
  };
  for (const { svg, scale } of charts) {
    svg.addEventListener('mousemove', (event) => {
      const [px] = placeIn(svg, event);
      if (px < scale.left || px > scale.right) hideAll(); else showAll(scale.x(px));
    });
    svg.addEventListener('mouseleave', hideAll);
  }
  if (map) {
    map.addEventListener('mousemove', (event) => {
      const [px, py] = placeIn(map, event);
      let best = -1, least = 20 * 20;
      for (let i = 0; i < trace.length; i += 3) {
        const dx = mapScale.px(trace[i + 1]) - px, dy = mapScale.py(trace[i + 2]) - py;
        if (dx * dx + dy * dy < least) { least = dx * dx + dy * dy; best = i; }
      }
      if (best < 0) hideAll(); else showAll(trace[best]);
    });
    map.addEventListener('mouseleave', hideAll);
  }

  // Plots without a common time: the place under the pointer.
  for (const svg of document.querySelectorAll('svg.plane:not([data-plot="map"])')) {
    const scale = scaleOf(svg);
    const read = svgNode('text',
      { class: 'read', x: scale.right - 6, y: scale.top + 16, 'text-anchor': 'end' }, svg);
    svg.addEventListener('mousemove', (event) => {
      const [px, py] = placeIn(svg, event);
      const inside = px >= scale.left && px <= scale.right && py >= scale.top && py <= scale.bottom;
      read.textContent = !inside ? '' :
        digits(scale.x(px), scale.x(scale.right) - scale.x(scale.left)) + ', ' +
        digits(scale.y(py), scale.y(scale.top) - scale.y(scale.bottom));
    });
    svg.addEventListener('mouseleave', () => { read.textContent = ''; });
  }
})();
)js";

}  // namespace pitwall::report
