#include "sinew/backend/jit/build_identity.h"

#include <link.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace sinew::backend {
namespace {

std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

// Notes are a header, a name and a description, each padded to words (System V ABI, "Note
// Section").
std::string identity_in(const char* notes, std::size_t size) {
  while (size >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) header;
    std::memcpy(&header, notes, sizeof header);
    const std::size_t name = sizeof header;
    const std::size_t description = name + padded(header.n_namesz);
    const std::size_t end = description + padded(header.n_descsz);
    if (end > size) break;
    if (header.n_type == NT_GNU_BUILD_ID &&
        std::string_view(notes + name, header.n_namesz) == std::string_view("GNU", 4)) {
      return {notes + description, header.n_descsz};
    }
    notes += end;
    size -= end;
  }
  return {};
}

bool contains(const dl_phdr_info& object, std::uintptr_t address) {
  for (std::size_t i = 0; i < object.dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object.dlpi_phdr[i];
    const std::uintptr_t begin = object.dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && address >= begin && address - begin < part.p_memsz) return true;
  }
  return false;
}

int look_into(dl_phdr_info* object, std::size_t, void* result) {
  if (!contains(*object, reinterpret_cast<std::uintptr_t>(&look_into))) return 0;
  for (std::size_t i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    std::string& identity = *static_cast<std::string*>(result);
    identity =
        identity_in(reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr), part.p_memsz);
    if (!identity.empty()) break;
  }
  return 1;
}

}  // namespace

std::string build_identity() {
  std::string identity;
  dl_iterate_phdr(look_into, &identity);
  return identity;
}

}  // namespace sinew::backend
