// Answers the cases of bench/sparql/compare with oxigraph: node oxigraph.mjs FOLDER DATA.nt CASES.json, where
// FOLDER/node_modules has it.
//
// Prints {"version", "queries": {name: {"us", "rows"}}}: the median of one query, and the rows of each anchor as
// N-Triples' terms. It has no prepared queries: the anchors are written into the text, and parsing is part of
// every time.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import path from 'node:path';

const ENOUGH_MS = 300; // of measuring, for each query, after each anchor was asked once

const [folder, data, casesFile] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(folder), 'package.json'));
const oxigraph = require('oxigraph');
const manifest = path.join(path.resolve(folder), 'node_modules/oxigraph/package.json');
const { version } = JSON.parse(readFileSync(manifest, 'utf8'));

const store = new oxigraph.Store();
store.load(readFileSync(data, 'utf8'), { format: 'application/n-triples' });

const queries = {};
for (const { name, text, parameters, columns, anchors } of JSON.parse(readFileSync(casesFile, 'utf8'))) {
  const texts = anchors.map((anchor) =>
    parameters.reduce(
      (bound, parameter, i) => bound.replaceAll(new RegExp(`\\?${parameter}(?!\\w)`, 'g'), () => anchor[i]),
      text.replaceAll(/^#.*$/gm, ''),
    ),
  );
  const rows = texts.map((bound) => {
    const answer = store.query(bound);
    if (columns === null) return [[String(answer)]];
    return answer.map((row) => columns.map((column) => row.get(column)?.toString() ?? '-'));
  });
  const times = [];
  const end = performance.now() + ENOUGH_MS;
  for (let i = 0; performance.now() < end; i = (i + 1) % texts.length) {
    const start = performance.now();
    store.query(texts[i]);
    times.push(performance.now() - start);
  }
  times.sort((a, b) => a - b);
  queries[name] = { us: times[times.length >> 1] * 1000, rows };
}
process.stdout.write(JSON.stringify({ version, queries }));
