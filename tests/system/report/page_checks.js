// What a person would complain about, found by measuring. The value is {plots, absent, complaints}.
// SPDX-License-Identifier: Apache-2.0
(() => {
  const complaints = [];
  const page = document.documentElement;
  const width = page.clientWidth;
  if (page.scrollWidth > width)
    complaints.push(`scrolls sideways: ${page.scrollWidth} of ${width}`);

  const plots = {};
  for (const svg of document.querySelectorAll('svg[data-plot]')) {
    const marks = [...svg.querySelectorAll('.mark')];
    const drawn = marks.filter((mark) => {
      const box = mark.getBBox();  // of dots their middles
      const isDots = mark.getAttribute('stroke-linecap') === 'round' && mark.getAttribute('d');
      return isDots || box.width + box.height > 0;
    });
    plots[svg.dataset.plot] = drawn.length;
    if (marks.length !== drawn.length) complaints.push(`${svg.dataset.plot}: an empty mark`);
    const frame = svg.getBoundingClientRect();
    for (const mark of marks) {
      const box = mark.getBoundingClientRect();
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 ||
          box.bottom > frame.bottom + 1) complaints.push(`${svg.dataset.plot}: a mark leaves it`);
    }
    for (const mark of svg.querySelectorAll('[d],[x],[cx]'))
      for (const name of ['d', 'x', 'y', 'width', 'height', 'cx', 'cy'])
        if (/nan|inf/i.test(mark.getAttribute(name) || ''))
          complaints.push(`${svg.dataset.plot}: NaN`);
  }

  const owners = [...document.querySelectorAll('body *')].filter((element) =>
    !['SCRIPT', 'STYLE', 'title'].includes(element.tagName) &&
    [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim() !== ''));
  const luminance = (colour) => {
    const parts = colour.match(/[\d.]+/g).slice(0, 3).map((value) => {
      const share = value / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
  };
  const ground = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const colour = getComputedStyle(at).backgroundColor;
      if (!/, 0\)$|transparent/.test(colour)) return colour;
    }
    return 'rgb(255, 255, 255)';
  };
  const texts = [];
  for (const element of owners) {
    const style = getComputedStyle(element);
    const box = element.getBoundingClientRect();
    if (box.width === 0 || style.visibility === 'hidden') continue;
    const words = element.textContent.trim().slice(0, 40);
    const svg = element.ownerSVGElement;
    const matrix = svg ? element.getScreenCTM() : { a: 1, b: 0 };
    const scale = Math.hypot(matrix.a, matrix.b);
    const size = parseFloat(style.fontSize) * scale;
    if (size < 11) complaints.push(`${size.toFixed(1)} px: ${words}`);
    if (box.left < -0.5 || box.right > width + 0.5) complaints.push(`outside the page: ${words}`);
    if (svg) {
      const frame = svg.getBoundingClientRect();
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 ||
          box.bottom > frame.bottom + 1) complaints.push(`outside its plot: ${words}`);
      if (!element.closest('.sign')) texts.push({ svg, box, words });
    } else {
      if (element.scrollWidth > element.clientWidth + 1 && style.display !== 'inline')
        complaints.push(`cut off: ${words}`);
      const [low, high] =
        [luminance(style.color), luminance(ground(element))].sort((a, b) => a - b);
      const contrast = (high + 0.05) / (low + 0.05);
      if (contrast < 4.5) complaints.push(`contrast ${contrast.toFixed(1)}: ${words}`);
    }
  }
  for (let i = 0; i < texts.length; ++i)
    for (let k = i + 1; k < texts.length && texts[k].svg === texts[i].svg; ++k) {
      const a = texts[i].box, b = texts[k].box;
      const over = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const under = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (over > 1 && under > 3)
        complaints.push(`over each other: ${texts[i].words} / ${texts[k].words}`);
    }
  const absent = [...document.querySelectorAll('[data-absent]')].map((e) => e.dataset.absent);
  return { plots, absent, complaints };
})()
