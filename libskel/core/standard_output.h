// A result that is written to the standard output stands there alone, so that other programs can read it.
#pragma once

#include <string>
#include <vector>

namespace skel {

// Where one of `outputs` is the standard output under another name (/dev/stdout): from now on what is printed
// goes to the standard error, and only what is written into that output to the standard output. Call it once,
// before there are threads.
void keepStandardOutputFor(const std::vector<std::string>& outputs);

// The descriptor that what is written into `path` goes to if that is the standard output; else -1.
int standardOutputNamed(const std::string& path);

// Whether a file lies at `path` that writing there replaces: not so of the standard output, whatever it is.
bool isFileToReplace(const std::string& path);

}  // namespace skel
