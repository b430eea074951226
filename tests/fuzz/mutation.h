// Random mutations of bytes that resemble corrupt files; the same mutations for the same seed.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace hooke {

class Mutator {
 public:
  // `seeds`: files to start from; `words`: tokens of the format. Neither may be empty.
  Mutator(std::vector<std::string> seeds, std::vector<std::string> words) : seeds_(std::move(seeds)), words_(std::move(words)) {}

  // Another file of at most 20 000 bytes.
  std::string next();

 private:
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
  void change(std::string& bytes);
  void replace_number(std::string& bytes);

  std::vector<std::string> seeds_, words_;
  std::mt19937_64 random_{20260717};
};

// The quoted words of a libFuzzer dictionary, with \xAB decoded.
std::vector<std::string> read_dictionary(const std::string& file);

}  // namespace hooke
