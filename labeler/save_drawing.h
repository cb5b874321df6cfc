// Label file and mask file of a drawing, changed together.
#pragma once

#include <string>

#include "libskel/labels/label_file.h"

namespace skel {

// The label file holds the hash of the mask file, but two files cannot be renamed in one go. So the new mask
// is first written beside the old one (<mask>.next), then the label file is replaced, then the mask is
// renamed. Whoever dies in between leaves files that finishSave() takes to the old state or to the new one.
// `png` are the bytes that `labels.mask` speaks of. Throws OutputError.
void saveWithMask(const std::string& label_file, const LabelFile& labels, const std::string& png);

// Completes, or takes back, what an earlier process did not finish. `label_file` need not exist.
void finishSave(const std::string& label_file);

// Throws OutputError where there is one and it stays.
void removeFile(const std::string& path);

// What a person has mended of a picture that has gone since: <stem>.mask.png becomes <stem>.old.mask.png, or
// .old-2 and so on where other content has that name; nothing where there is no such file. Throws
// OutputError.
void keepAside(const std::string& path);

}  // namespace skel
