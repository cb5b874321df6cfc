skel_headers(Eigen3::Eigen eigen3/Eigen eigen3/unsupported)
set(Eigen3_FOUND ON)
