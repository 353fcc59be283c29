'use strict';
// Reading values off the curves: by mouse, finger or arrow keys.
const tip = document.getElementById('tip');
const digits = value => Number(value.toPrecision(4)).toString();
for (const figure of document.querySelectorAll('figure:has(.plot)')) {
  const panels = JSON.parse(figure.querySelector('script').textContent);
  const plot = figure.querySelector('.plot');
  const drawings = [...plot.querySelectorAll('svg')];
  const reading = figure.querySelector('.reading');
  const cursor = document.createElementNS('http://www.w3.org/2000/svg', 'line');
  cursor.setAttribute('class', 'cursor');
  let at = null; // panel and position along its axis, between 0 and 1
  const position = (scale, value) => scale === 'log' ? Math.log10(value) : value;
  const valueAt = (place, share) => {
    const [from, to] = place.x_range.map(value => position(place.x_scale, value));
    const along = from + share * (to - from);
    return place.x_scale === 'log' ? 10 ** along : along;
  };
  // the value of a line at x: where its points run along x, the nearest of them
  const nearest = (points, x, place) => {
    let best = null, least = Infinity;
    for (const point of points) {
      const distance = Math.abs(position(place.x_scale, point[0]) - position(place.x_scale, x));
      if (distance < least) { least = distance; best = point; }
    }
    return best;
  };
  const read = (panel, share) => {
    const { place, lines } = panel;
    const x = valueAt(place, share);
    const words = [(panel.title ? panel.title + ': ' : '') + panel.x + ' ' + digits(x)];
    for (const line of lines) {
      const point = nearest(line.points, x, place);
      if (point) words.push(line.name + ': ' + digits(point[1]));
    }
    words.push('(' + panel.y + ')');
    return words;
  };
  const show = (panel, share) => {
    const { x_pixels: [left, right], y_pixels: [top, bottom] } = panel.place;
    const x = left + share * (right - left);
    for (const [name, value] of Object.entries({ x1: x, x2: x, y1: top, y2: bottom })) cursor.setAttribute(name, value);
    drawings[panels.indexOf(panel)].append(cursor);
    at = { panel, share };
    return read(panel, share);
  };
  const hide = () => { cursor.remove(); tip.hidden = true; };
  const point = event => {
    const under = drawings.findIndex(svg => {
      const box = svg.getBoundingClientRect();
      return event.clientX >= box.left && event.clientX <= box.right && event.clientY >= box.top && event.clientY <= box.bottom;
    });
    const panel = panels[under];
    if (!panel || !panel.lines.length) { hide(); return; }
    const box = drawings[under].getBoundingClientRect();
    const zoom = drawings[under].viewBox.baseVal.width / box.width;
    const x = (event.clientX - box.left) * zoom;
    const [left, right] = panel.place.x_pixels;
    if (x < left || x > right) { hide(); return; }
    tip.textContent = show(panel, (x - left) / (right - left)).join('\n');
    tip.hidden = false;
    const place = tip.getBoundingClientRect();
    tip.style.left = Math.max(4, Math.min(event.clientX + 16, innerWidth - place.width - 8)) + 'px';
    tip.style.top = Math.max(4, Math.min(event.clientY + 16, innerHeight - place.height - 8)) + 'px';
  };
  plot.addEventListener('pointermove', point);
  plot.addEventListener('pointerdown', point);
  plot.addEventListener('pointerleave', hide);
  plot.addEventListener('blur', hide);
  plot.addEventListener('keydown', event => {
    const readable = panels.filter(panel => panel.lines.length);
    if (!readable.length) return;
    let { panel, share } = at ?? { panel: readable[0], share: 0.2 };
    let index = Math.max(0, readable.indexOf(panel));
    const step = event.shiftKey ? 0.1 : 0.01;
    switch (event.key) {
      case 'ArrowRight': share = Math.min(1, share + step); break;
      case 'ArrowLeft': share = Math.max(0, share - step); break;
      case 'ArrowDown': index = (index + 1) % readable.length; break;
      case 'ArrowUp': index = (index + readable.length - 1) % readable.length; break;
      case 'Escape': hide(); return;
      default: return;
    }
    event.preventDefault();
    reading.textContent = show(readable[index], share).join(' · ');
  });
}
// Tables: sorted by a click on a heading, copied for a spreadsheet.
for (const table of document.querySelectorAll('.block table')) {
  const heads = [...table.querySelectorAll('thead tr:last-child th')];
  heads.forEach((head, column) => head.querySelector('button')?.addEventListener('click', () => {
    const up = head.getAttribute('aria-sort') !== 'ascending';
    heads.forEach(other => other.removeAttribute('aria-sort'));
    head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    const body = table.tBodies[0];
    const key = row => row.cells[column].textContent;
    const compare = (a, b) => {
      const [x, y] = [parseFloat(key(a)), parseFloat(key(b))];
      const order = Number.isNaN(x) || Number.isNaN(y) ? key(a).localeCompare(key(b)) : x - y;
      return up ? order : -order;
    };
    body.append(...[...body.rows].sort(compare));
  }));
}
for (const button of document.querySelectorAll('.copy')) {
  button.addEventListener('click', async () => {
    const rows = [...button.closest('.block').querySelectorAll('tr:not(.group)')];
    const text = rows.map(row => [...row.cells].map(cell => cell.textContent).join('\t')).join('\n');
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      // a page opened from a file may not be allowed to: select and copy the old way
      const area = document.createElement('textarea');
      area.value = text;
      document.body.append(area);
      area.select();
      document.execCommand('copy');
      area.remove();
      button.focus();
    }
    button.textContent = 'Copied';
    setTimeout(() => { button.textContent = 'Copy table'; }, 1500);
  });
}
// On paper nothing can be opened: what warns is printed open.
addEventListener('beforeprint', () => document.querySelectorAll('.alarms details').forEach(more => { more.open = true; }));
