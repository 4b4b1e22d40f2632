// Processes documents with npm's jsonld, for comparison. Offline: the only documents that an IRI can
// lead to are those of the directory.
//
//   node npm_oracle.mjs NODE_MODULES OPERATION PREFIX DIRECTORY FILE…
//
// OPERATION is "toRdf" (N-Quads) or "flatten" (JSON). The IRI of a document is PREFIX and its path in
// DIRECTORY. Prints, for each FILE, one line of JSON: { "result": … } or { "error": code }.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const [modules, operation, prefix, directory, ...files] = process.argv.slice(2);
const jsonld = createRequire(join(modules, 'x.js'))('jsonld');

const documentLoader = async (url) => {
  if (!url.startsWith(prefix)) throw new Error(`not in the directory: ${url}`);
  const document = JSON.parse(readFileSync(join(directory, url.slice(prefix.length)), 'utf8'));
  return { contextUrl: null, documentUrl: url, document };
};

for (const file of files) {
  try {
    const document = JSON.parse(readFileSync(file, 'utf8'));
    const options = { documentLoader, base: `https://example.org/${file.split('/').pop()}` };
    const result = operation === 'toRdf'
      ? await jsonld.toRDF(document, { ...options, format: 'application/n-quads' })
      : await jsonld.flatten(document, null, options);
    console.log(JSON.stringify({ result }));
  } catch (error) {
    console.log(JSON.stringify({ error: error.details?.code ?? String(error.message) }));
  }
}
