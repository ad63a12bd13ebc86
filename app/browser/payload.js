// The data of a report: a header in JSON and columns of numbers, deflated, in base64. app/command/report_data.cpp writes
// it. Columns are decoded when they are first used.

const missing = 0xffff; // of a quantised column

async function inflated(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/// A table of columns; numbers are NaN and words are empty where nothing is known.
export class Table {
  constructor(described, buffer, body) {
    this.name = described.name;
    this.title = described.title;
    this.rows = described.rows;
    this.columns = described.columns;
    this.leftOut = described.left_out ?? [];
    this.byName = new Map(described.columns.map((column) => [column.name, column]));
    this.buffer = buffer;
    this.body = body;
    this.decoded = new Map();
  }

  has(name) {
    return this.byName.has(name);
  }

  isNumeric(name) {
    return this.has(name) && this.byName.get(name).form !== 'words';
  }

  /// Float64Array of a column of numbers; all NaN without the column.
  numbers(name) {
    if (!this.decoded.has(name)) this.decoded.set(name, this.decode(this.byName.get(name)));
    return this.decoded.get(name);
  }

  /// One cell as a word.
  word(name, row) {
    const column = this.byName.get(name);
    if (!column) return '';
    return column.form === 'words' ? column.words[this.numbers(name)[row]] : String(this.numbers(name)[row]);
  }

  decode(column) {
    const values = new Float64Array(this.rows).fill(NaN);
    if (!column) return values;
    const at = this.body + column.at;
    const rows = this.rows;
    if (column.form === 'float64') {
      // Byte k of all numbers stands together, which deflates better.
      const planes = new Uint8Array(this.buffer, at, 8 * rows);
      const bytes = new Uint8Array(values.buffer);
      for (let k = 0; k < 8; ++k) for (let i = 0; i < rows; ++i) bytes[8 * i + k] = planes[k * rows + i];
      return values;
    }
    const view = new DataView(this.buffer, at);
    if (column.form === 'quantised') {
      for (let i = 0; i < rows; ++i) {
        const level = view.getUint16(2 * i, true);
        values[i] = level === missing ? NaN : column.low + column.step * level;
      }
    } else if (column.form === 'uint32') {
      for (let i = 0; i < rows; ++i) values[i] = view.getUint32(4 * i, true);
    } else {
      for (let i = 0; i < rows; ++i) values[i] = view.getUint16(2 * i, true); // indices of words
    }
    return values;
  }
}

/// The header, with each table of each study as a Table.
export async function readPayload(text) {
  const buffer = await inflated(text.trim());
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const body = 8 * Math.ceil((4 + length) / 8);
  for (const study of header.studies) {
    study.tables = study.tables.map((table) => new Table(table, buffer, body));
    study.table = (name) => study.tables.find((table) => table.name === name);
  }
  return header;
}
