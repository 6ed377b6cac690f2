// Declares the types of CLI11 that headers of the program name. Files that use them include CLI/CLI.hpp,
// which takes seconds to compile.
#pragma once

namespace CLI {
class App;
class Option;
class ParseError;
class Validator;
}  // namespace CLI
