// Pictures that got another name after they were mended: what was mended is looked for by the new one.
#pragma once

#include <string>
#include <vector>

namespace skel {

// A sentence for each label file that lies beside some of the `drawings`, in which a person has placed joints
// or painted a mask, whose picture is gone and was, byte for byte, what one of them is now. In the order of
// the folders and drawings. What cannot be read is passed over.
std::vector<std::string> renamedNotes(const std::vector<std::string>& drawings);

}  // namespace skel
