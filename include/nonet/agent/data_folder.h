// Where a program or a library of Nonet finds params/ and skills/.
#pragma once

#include <string>

#include "nonet/config/parameters.h"

namespace nonet::agent {

/// The data are missing, wholly or in part.
class DataError : public config::ParameterError {
 public:
  using config::ParameterError::ParameterError;
};

/// The folder with params/ and skills/: `given` if not empty, otherwise the environment variable NONET_DATA
/// if set, otherwise found from the program's file, an executable or a library (findData()). `givenBy` is
/// what errors call the first of these, such as "--data". Throws DataError that says what is missing and
/// where it was looked for: without its data an agent would play on, crippled.
std::string dataFolder(const std::string& given, const std::string& givenBy, const std::string& programFile,
                       const std::string& sourceFolder);

/// The nearest folder above `programFile` that holds params/ and skills/ itself (a source tree, an unpacked
/// archive) or in share/nonet (an installation); otherwise `sourceFolder` if it does. Throws DataError that
/// names NONET_DATA and `givenBy` as remedies.
std::string findData(const std::string& programFile, const std::string& givenBy,
                     const std::string& sourceFolder);

}  // namespace nonet::agent
