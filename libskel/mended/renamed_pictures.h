// Pictures that got another name after they were mended: what was mended is looked for by the new one.
#pragma once

#include <string>
#include <vector>

namespace skel {

// A sentence for each label file that lies beside some of the `drawings`, in which a person has placed joints
// or painted a mask, and for each skeleton file in the folders of mend_places.h, in which a person has moved
// joints, or that names a mask, whose picture is gone and was, byte for byte, what one of them is now. In the
// order of the folders and drawings. What cannot be read is passed over; no picture is read where there is no
// such file. `out_dir`: where the run writes, or an earlier one has written; "": nowhere.
std::vector<std::string> renamedNotes(const std::vector<std::string>& drawings, const std::string& out_dir);

}  // namespace skel
