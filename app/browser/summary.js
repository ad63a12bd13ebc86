// The pages in words that the commands write (sweep.md, continue.md, ...): headings, paragraphs, lists and tables of
// Markdown as elements. Nothing of a text becomes markup of its own.
import { element } from './words.js';

/// Code, strong words and links within a line; a link keeps its words only.
function inline(text) {
  const made = document.createDocumentFragment();
  const plain = (part) =>
    part
      .replace(/\\([\\`*_{}[\]()<>#+.!|~-])/g, '$1')
      .replace(/&lt;/g, '<')
      .replace(/&gt;/g, '>')
      .replace(/&amp;/g, '&');
  let end = 0;
  for (const found of text.matchAll(/`([^`]+)`|(?<!\\)\*\*([^*]+)\*\*|!?(?<!\\)\[([^\]]*)\]\([^)]*\)/g)) {
    made.append(plain(text.slice(end, found.index)));
    if (found[1] !== undefined) made.append(element('code', { text: found[1] }));
    else if (found[2] !== undefined) made.append(element('strong', { text: plain(found[2]) }));
    else made.append(plain(found[3]));
    end = found.index + found[0].length;
  }
  made.append(plain(text.slice(end)));
  return made;
}

const cellsOf = (line) =>
  line
    .trim()
    .replace(/^\||\|$/g, '')
    .split(/(?<!\\)\|/)
    .map((cell) => cell.trim());

function tableFrom(lines) {
  const row = (tag, cells) =>
    element(
      'tr',
      {},
      cells.map((cell) => element(tag, tag === 'th' ? { scope: 'col' } : {}, inline(cell))),
    );
  return element(
    'div',
    { class: 'scroll' },
    element(
      'table',
      {},
      element('thead', {}, row('th', cellsOf(lines[0]))),
      element(
        'tbody',
        {},
        lines.slice(2).map((line) => row('td', cellsOf(line))),
      ),
    ),
  );
}

/// @param text  Markdown as this program writes it
export function summaryOf(text) {
  const made = element('div', { class: 'summary' });
  const lines = text.split('\n');
  const takeWhile = (k, holds) => {
    let end = k;
    while (end < lines.length && holds(lines[end])) ++end;
    return lines.slice(k, end);
  };
  for (let k = 0; k < lines.length;) {
    const line = lines[k];
    const heading = /^(#{1,4}) (.*)/.exec(line);
    if (heading) {
      made.append(element(`h${Math.min(5, heading[1].length + 2)}`, {}, inline(heading[2])));
      ++k;
    } else if (line.startsWith('|') && /^\|[-| :]+\|?\s*$/.test(lines[k + 1] ?? '')) {
      const rows = takeWhile(k, (one) => one.startsWith('|'));
      made.append(tableFrom(rows));
      k += rows.length;
    } else if (line.startsWith('```')) {
      const code = takeWhile(k + 1, (one) => !one.startsWith('```'));
      made.append(element('pre', { text: code.join('\n') }));
      k += code.length + 2;
    } else if (/^[-*] /.test(line)) {
      const items = takeWhile(k, (one) => /^([-*] |\s+\S)/.test(one));
      const list = element('ul');
      for (const item of items)
        if (/^[-*] /.test(item)) list.append(element('li', {}, inline(item.slice(2))));
        else list.lastChild.append(' ', inline(item.trim()));
      made.append(list);
      k += items.length;
    } else if (line.trim() === '') {
      ++k;
    } else {
      const words = takeWhile(k, (one) => one.trim() !== '' && !/^(#{1,4} |\||[-*] |```)/.test(one));
      made.append(element('p', {}, inline((words.length > 0 ? words : [line]).join(' '))));
      k += Math.max(1, words.length);
    }
  }
  return made;
}
