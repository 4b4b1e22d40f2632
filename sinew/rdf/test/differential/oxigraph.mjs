// Answers the queries of a folder with oxigraph: for each line of cases.jsonl, a file NUMBER.srj or
// NUMBER.nt, or NUMBER.error with the message.
//
//   node oxigraph.mjs FOLDER     (oxigraph is installed in FOLDER/node_modules)
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';

const folder = path.resolve(process.argv[2]);
const oxigraph = createRequire(path.join(folder, 'package.json'))('oxigraph');

const stores = new Map();
function store(graph) {
  if (!stores.has(graph)) {
    const loaded = new oxigraph.Store();
    loaded.load(readFileSync(path.join(folder, `graph${graph}.nq`), 'utf8'), {
      format: 'application/n-quads',
    });
    stores.set(graph, loaded);
  }
  return stores.get(graph);
}

const lines = readFileSync(path.join(folder, 'cases.jsonl'), 'utf8').split('\n').filter(Boolean);
lines.forEach((line, number) => {
  const { graph, union, construct, query } = JSON.parse(line);
  const write = (end, text) => writeFileSync(path.join(folder, 'answers', `${number}.${end}`), text);
  try {
    const answer = store(graph).query(query, {
      results_format: construct ? 'application/n-triples' : 'application/sparql-results+json',
      use_default_graph_as_union: union,
    });
    write(construct ? 'nt' : 'srj', answer);
  } catch (error) {
    write('error', String(error));
  }
});
