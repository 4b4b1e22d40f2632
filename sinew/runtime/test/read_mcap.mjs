// Reads an MCAP file with npm's @mcap/core, once through its index and once record by record, and prints what is
// in it, one JSON value a line. usage: node read_mcap.mjs NODE_MODULES FILE
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [modules, file] = process.argv.slice(2);
const { McapIndexedReader, McapStreamReader } = createRequire(modules + "/")("@mcap/core");
const bytes = readFileSync(file);
const text = (data) => new TextDecoder().decode(data);
const print = (value) =>
  console.log(JSON.stringify(value, (key, each) => (typeof each === "bigint" ? String(each) : each)));

const reader = await McapIndexedReader.Initialize({
  readable: {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
  },
});
print({ statistics: reader.statistics, library: reader.header.library, chunks: reader.chunkIndexes.length });
for (const channel of reader.channelsById.values()) {
  const schema = reader.schemasById.get(channel.schemaId);
  print({ topic: channel.topic, encoding: channel.messageEncoding, schema: JSON.parse(text(schema.data)) });
}
let indexed = 0, last = null;
for await (const message of reader.readMessages()) {
  ++indexed;
  last = { topic: reader.channelsById.get(message.channelId).topic, time: message.logTime,
           message: JSON.parse(text(message.data)) };
}
print({ indexed, last });

const stream = new McapStreamReader({ validateCrcs: true });
stream.append(bytes);
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") ++streamed;
print({ streamed, done: stream.done() });
