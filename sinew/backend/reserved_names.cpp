#include "sinew/backend/reserved_names.h"

#include <algorithm>
#include <functional>
#include <string>
#include <unordered_set>

namespace sinew::backend {
namespace {

// Words of C11 and C++20.
constexpr std::string_view kWords[] = {"alignas",     "alignof",
                                       "and",         "and_eq",
                                       "asm",         "auto",
                                       "bitand",      "bitor",
                                       "bool",        "break",
                                       "case",        "catch",
                                       "char",        "char16_t",
                                       "char32_t",    "char8_t",
                                       "class",       "co_await",
                                       "co_return",   "co_yield",
                                       "compl",       "concept",
                                       "const",       "const_cast",
                                       "consteval",   "constexpr",
                                       "constinit",   "continue",
                                       "decltype",    "default",
                                       "delete",      "do",
                                       "double",      "dynamic_cast",
                                       "else",        "enum",
                                       "explicit",    "export",
                                       "extern",      "false",
                                       "float",       "for",
                                       "friend",      "goto",
                                       "if",          "import",
                                       "inline",      "int",
                                       "long",        "main",
                                       "module",      "mutable",
                                       "namespace",   "new",
                                       "noexcept",    "not",
                                       "not_eq",      "nullptr",
                                       "operator",    "or",
                                       "or_eq",       "private",
                                       "protected",   "public",
                                       "register",    "reinterpret_cast",
                                       "requires",    "restrict",
                                       "return",      "short",
                                       "signed",      "sizeof",
                                       "static",      "static_assert",
                                       "static_cast", "struct",
                                       "switch",      "template",
                                       "this",        "thread_local",
                                       "throw",       "true",
                                       "try",         "typedef",
                                       "typeid",      "typename",
                                       "typeof",      "union",
                                       "unsigned",    "using",
                                       "virtual",     "void",
                                       "volatile",    "wchar_t",
                                       "while",       "xor",
                                       "xor_eq"};

// Macros of the C library, and what GNU compilers define without being asked for a standard.
constexpr std::string_view kMacros[] = {"EOF",           "FP_INFINITE",  "FP_NAN",
                                        "FP_NORMAL",     "FP_SUBNORMAL", "FP_ZERO",
                                        "HUGE_VAL",      "HUGE_VALF",    "HUGE_VALL",
                                        "INFINITY",      "NAN",          "NULL",
                                        "assert",        "complex",      "errno",
                                        "fpclassify",    "i386",         "imaginary",
                                        "isfinite",      "isgreater",    "isgreaterequal",
                                        "isinf",         "isless",       "islessequal",
                                        "islessgreater", "isnan",        "isnormal",
                                        "isunordered",   "linux",        "math_errhandling",
                                        "noreturn",      "offsetof",     "setjmp",
                                        "signbit",       "stderr",       "stdin",
                                        "stdout",        "unix",         "va_arg",
                                        "va_copy",       "va_end",       "va_start"};

// Types that headers of the C library bring along, and C++'s namespace.
constexpr std::string_view kTypes[] = {
    "FILE",     "clock_t",  "div_t",       "double_t", "float_t",   "fpos_t",
    "int16_t",  "int32_t",  "int64_t",     "int8_t",   "intmax_t",  "intptr_t",
    "ldiv_t",   "lldiv_t",  "max_align_t", "off_t",    "pid_t",     "ptrdiff_t",
    "size_t",   "ssize_t",  "std",         "time_t",   "timespec",  "tm",
    "uint16_t", "uint32_t", "uint64_t",    "uint8_t",  "uintmax_t", "uintptr_t"};

// Functions of libm; each has two more, with an f and an l behind.
constexpr std::string_view kMathematics[] = {
    "acos",       "acosh",  "asin",        "asinh",  "atan",   "atan2",     "atanh",
    "cabs",       "carg",   "cbrt",        "ceil",   "cexp",   "cimag",     "conj",
    "copysign",   "cos",    "cosh",        "cproj",  "creal",  "csqrt",     "drem",
    "erf",        "erfc",   "exp",         "exp10",  "exp2",   "expm1",     "fabs",
    "fdim",       "floor",  "fma",         "fmax",   "fmin",   "fmod",      "frexp",
    "gamma",      "hypot",  "ilogb",       "j0",     "j1",     "jn",        "ldexp",
    "lgamma",     "llrint", "llround",     "log",    "log10",  "log1p",     "log2",
    "logb",       "lrint",  "lround",      "modf",   "nan",    "nearbyint", "nextafter",
    "nexttoward", "pow",    "remainder",   "remquo", "rint",   "round",     "scalb",
    "scalbln",    "scalbn", "significand", "sin",    "sincos", "sinh",      "sqrt",
    "tan",        "tanh",   "tgamma",      "trunc",  "y0",     "y1",        "yn"};

// Functions of libc that compilers know by heart, or that a program is likely to link.
constexpr std::string_view kFunctions[] = {
    "abort",       "abs",       "accept",   "access",     "alarm",        "aligned_alloc",
    "alloca",      "asctime",   "atexit",   "atof",       "atoi",         "atol",
    "atoll",       "bcmp",      "bcopy",    "bind",       "brk",          "bsearch",
    "bzero",       "calloc",    "chdir",    "chmod",      "chown",        "clearerr",
    "clock",       "close",     "closedir", "connect",    "creat",        "ctime",
    "daemon",      "difftime",  "div",      "dprintf",    "dup",          "dup2",
    "environ",     "execl",     "execv",    "execve",     "exit",         "fclose",
    "fcntl",       "fdopen",    "feof",     "ferror",     "fflush",       "ffs",
    "fgetc",       "fgetpos",   "fgets",    "fileno",     "finite",       "fopen",
    "fork",        "fprintf",   "fputc",    "fputs",      "fread",        "free",
    "freopen",     "fscanf",    "fseek",    "fsetpos",    "fstat",        "fsync",
    "ftell",       "ftruncate", "fwrite",   "getc",       "getchar",      "getcwd",
    "getenv",      "getopt",    "getpid",   "gets",       "gettimeofday", "getuid",
    "gmtime",      "index",     "ioctl",    "isalnum",    "isalpha",      "isascii",
    "isatty",      "isblank",   "iscntrl",  "isdigit",    "isgraph",      "islower",
    "isprint",     "ispunct",   "isspace",  "isupper",    "isxdigit",     "kill",
    "labs",        "ldiv",      "link",     "listen",     "llabs",        "lldiv",
    "localeconv",  "localtime", "longjmp",  "lseek",      "malloc",       "mblen",
    "mbtowc",      "memchr",    "memcmp",   "memcpy",     "memmove",      "memset",
    "mkdir",       "mkstemp",   "mktime",   "mmap",       "munmap",       "nanosleep",
    "nice",        "open",      "opendir",  "pause",      "perror",       "pipe",
    "poll",        "printf",    "putc",     "putchar",    "putenv",       "puts",
    "qsort",       "raise",     "rand",     "random",     "read",         "readdir",
    "realloc",     "recv",      "remove",   "rename",     "rewind",       "rindex",
    "rmdir",       "sbrk",      "scanf",    "select",     "send",         "setbuf",
    "setenv",      "setlocale", "setvbuf",  "shutdown",   "sigaction",    "signal",
    "signgam",     "sleep",     "snprintf", "socket",     "sprintf",      "srand",
    "srandom",     "sscanf",    "stat",     "strcasecmp", "strcat",       "strchr",
    "strcmp",      "strcoll",   "strcpy",   "strcspn",    "strdup",       "strerror",
    "strftime",    "strlen",    "strncat",  "strncmp",    "strncpy",      "strndup",
    "strpbrk",     "strrchr",   "strspn",   "strstr",     "strtod",       "strtof",
    "strtok",      "strtol",    "strtold",  "strtoll",    "strtoul",      "strtoull",
    "strxfrm",     "swab",      "symlink",  "sync",       "syscall",      "system",
    "thrd_create", "time",      "times",    "timezone",   "tmpfile",      "tmpnam",
    "toascii",     "tolower",   "toupper",  "truncate",   "tzset",        "umask",
    "uname",       "ungetc",    "unlink",   "usleep",     "utime",        "vfork",
    "vfprintf",    "vprintf",   "vscanf",   "vsnprintf",  "vsprintf",     "wait",
    "waitpid",     "wcslen",    "wctomb",   "write"};

// Looked up without a copy of the name.
struct Hash : std::hash<std::string_view> {
  using is_transparent = void;
};
using Names = std::unordered_set<std::string, Hash, std::equal_to<>>;

Names all_names() {
  Names names;
  for (const std::string_view name : kMathematics)
    for (const char* suffix : {"", "f", "l"}) names.insert(std::string(name) + suffix);
  const auto add = [&](const auto& table) {
    for (const std::string_view name : table) names.emplace(name);
  };
  add(kWords);
  add(kMacros);
  add(kTypes);
  add(kFunctions);
  return names;
}

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

}  // namespace

bool is_reserved_in_c(std::string_view name) {
  // C11, 7.1.3: what begins with two underscores, or one and a capital, belongs to the
  // implementation. <math.h> has constants M_PI and so on.
  if (name.size() > 1 && name[0] == '_' && (name[1] == '_' || is_capital(name[1]))) return true;
  if (name.starts_with("M_")) return true;
  // Most names of generated code are longer than all of these.
  static const Names names = all_names();
  static const std::size_t longest =
      std::ranges::max_element(names, {}, &std::string::size)->size();
  return name.size() <= longest && names.contains(name);
}

}  // namespace sinew::backend
