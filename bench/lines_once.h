// Benchmarks do the same again and again: what the pipeline warns of is told once.
#pragma once

#include <iostream>
#include <set>
#include <streambuf>
#include <string>

namespace sinew {

// While it lives, a line that std::cerr has had before is not printed again.
class LinesOnce : public std::streambuf {
 public:
  LinesOnce() : before_(std::cerr.rdbuf(this)) {}
  ~LinesOnce() override { std::cerr.rdbuf(before_); }
  LinesOnce(const LinesOnce&) = delete;
  LinesOnce& operator=(const LinesOnce&) = delete;

 protected:
  int_type overflow(int_type next) override {
    if (next == traits_type::eof()) return traits_type::not_eof(next);
    line_ += traits_type::to_char_type(next);
    if (line_.back() != '\n') return next;
    if (told_.insert(line_).second) before_->sputn(line_.data(), std::streamsize(line_.size()));
    line_.clear();
    return next;
  }

 private:
  std::streambuf* before_;
  std::string line_;
  std::set<std::string> told_;
};

}  // namespace sinew
