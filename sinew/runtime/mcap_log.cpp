#include "sinew/runtime/mcap_log.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "sinew/runtime/crc32.h"

namespace sinew::runtime {
namespace {

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

// Little-endian fields, as the specification has them.
class Fields {
 public:
  template <typename Integer>
  Fields& number(Integer value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
    return *this;
  }
  Fields& u16(std::uint16_t value) { return number(value); }
  Fields& u32(std::uint32_t value) { return number(value); }
  Fields& u64(std::uint64_t value) { return number(value); }
  Fields& text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
    return *this;
  }
  Fields& raw(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  // A map or array, which is prefixed with its length in bytes.
  Fields& block(const Fields& value) { return text(value.bytes_); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(Opcode opcode, const Fields& fields) {
  Fields whole;
  whole.number(static_cast<std::uint8_t>(opcode)).u64(fields.bytes().size()).raw(fields.bytes());
  return whole.bytes();
}

std::uint32_t crc32(std::string_view bytes) {
  return runtime::crc32(std::as_bytes(std::span(bytes)));
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      result += c;
  }
  return result + "\"";
}

std::string schema_of(const LogChannel& channel) {
  std::string text = R"({"type":"object","properties":{"tick":{"type":"integer"})";
  for (std::size_t i = 0; i < channel.columns.size(); ++i) {
    text += "," + quoted(channel.columns[i]) + R"(:{"type":"number")";
    if (i < channel.units.size() && !channel.units[i].empty())
      text += R"(,"description":)" + quoted(channel.units[i]);
    text += "}";
  }
  return text + "}}";
}

std::uint16_t id_of(std::size_t channel) { return static_cast<std::uint16_t>(channel + 1); }

}  // namespace

McapLog::McapLog(const std::string& path, std::vector<LogChannel> channels, std::int64_t start)
    : file_(path), channels_(std::move(channels)), start_(start) {
  Fields header;
  header.text("").text("sinew");
  checked(file_.write(kMagic) && file_.write(record(kHeader, header)));
  chunk_ = schemas_and_channels();
}

bool McapLog::checked(bool good) {
  if (!good) fault_ = file_.fault();
  return good;
}

std::string McapLog::schemas_and_channels() const {
  std::string records;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const LogChannel& channel = channels_[i];
    Fields schema, about;
    schema.u16(id_of(i)).text(channel.label).text("jsonschema").text(schema_of(channel));
    about.u16(id_of(i)).u16(id_of(i)).text(channel.label).text("json").block({});
    records += record(kSchema, schema) + record(kChannel, about);
  }
  return records;
}

bool McapLog::write(std::uint64_t tick, Nanoseconds time, std::span<const double> row) {
  const auto stamp = static_cast<std::uint64_t>(start_ + time);
  if (messages_ == 0) first_ = stamp;
  if (chunk_messages_.empty()) chunk_first_ = stamp;
  chunk_last_ = last_ = stamp;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const LogChannel& channel = channels_[i];
    std::string text = fmt::format("{{\"tick\":{}", tick);
    for (std::size_t column = 0; column < channel.columns.size(); ++column) {
      const double number = row[channel.places[column]];
      text += "," + quoted(channel.columns[column]) + ":";
      // JSON has no word for what is not a number.
      if (std::isfinite(number))
        fmt::format_to(std::back_inserter(text), "{}", number);
      else
        text += "null";
    }
    text += "}";
    Fields message;
    message.u16(id_of(i)).u32(sequence_).u64(stamp).u64(stamp).raw(text);
    chunk_messages_[id_of(i)].push_back({stamp, chunk_.size()});
    chunk_ += record(kMessage, message);
    ++messages_;
  }
  ++sequence_;
  return chunk_.size() < kChunkBytes || end_chunk();
}

bool McapLog::end_chunk() {
  if (chunk_.empty()) return fault_.empty();
  ChunkIndex index{chunk_first_, chunk_last_, file_.position(), 0, 0, chunk_.size(), {}};
  Fields chunk;
  chunk.u64(chunk_first_).u64(chunk_last_).u64(chunk_.size()).u32(crc32(chunk_)).text("");
  chunk.u64(chunk_.size()).raw(chunk_);
  if (!checked(file_.write(record(kChunk, chunk)))) return false;
  index.length = file_.position() - index.start;
  for (const auto& [channel, entries] : chunk_messages_) {
    index.indexes[channel] = file_.position();
    Fields places, messages;
    for (const Entry& entry : entries) places.u64(entry.time).u64(entry.offset);
    messages.u16(channel).block(places);
    if (!checked(file_.write(record(kMessageIndex, messages)))) return false;
  }
  index.messages_length = file_.position() - index.start - index.length;
  chunks_.push_back(std::move(index));
  chunk_.clear();
  chunk_messages_.clear();
  return true;
}

// Schemas, channels, chunk indexes and statistics again, for readers that start at the end.
std::string McapLog::summary() {
  const std::uint64_t start = file_.position();
  std::string records = schemas_and_channels();
  const std::uint64_t indexes = start + records.size();
  for (const ChunkIndex& chunk : chunks_) {
    Fields places, fields;
    for (const auto& [channel, place] : chunk.indexes) places.u16(channel).u64(place);
    fields.u64(chunk.first_time).u64(chunk.last_time).u64(chunk.start).u64(chunk.length);
    fields.block(places).u64(chunk.messages_length).text("").u64(chunk.size).u64(chunk.size);
    records += record(kChunkIndex, fields);
  }
  const std::uint64_t statistics = start + records.size();
  const std::uint64_t each = channels_.empty() ? 0 : messages_ / channels_.size();
  Fields counts, fields;
  for (std::size_t i = 0; i < channels_.size(); ++i) counts.u16(id_of(i)).u64(each);
  fields.u64(messages_).u16(static_cast<std::uint16_t>(channels_.size()));
  fields.u32(static_cast<std::uint32_t>(channels_.size())).u32(0).u32(0);
  fields.u32(static_cast<std::uint32_t>(chunks_.size())).u64(first_).u64(last_).block(counts);
  records += record(kStatistics, fields);
  const std::uint64_t offsets = start + records.size();
  const auto group = [&](Opcode opcode, std::uint64_t from, std::uint64_t to) {
    if (to == from) return;
    Fields offset;
    offset.number(static_cast<std::uint8_t>(opcode)).u64(from).u64(to - from);
    records += record(kSummaryOffset, offset);
  };
  group(kChunkIndex, indexes, statistics);
  group(kStatistics, statistics, offsets);

  // The footer's checksum covers the summary and the footer up to the checksum itself.
  Fields places;
  places.u64(start).u64(offsets);
  Fields opening;
  opening.number(static_cast<std::uint8_t>(kFooter)).u64(places.bytes().size() + 4);
  const std::string covered = records + opening.bytes() + places.bytes();
  Fields checksum;
  checksum.u32(crc32(covered));
  return covered + checksum.bytes();
}

bool McapLog::flush() { return checked(file_.flush()); }

bool McapLog::close() {
  if (closed_) return fault_.empty();
  closed_ = true;
  Fields end;
  end.u32(0);  // no checksum of the data section; every chunk has its own
  if (fault_.empty() && end_chunk() && checked(file_.write(record(kDataEnd, end))) &&
      checked(file_.write(summary())) && checked(file_.write(kMagic)))
    return checked(file_.close());
  file_.close();
  return false;
}

}  // namespace sinew::runtime
