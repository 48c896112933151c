/* intrin0.h - stands for MSVC's, to which clang's of the same name adds the intrinsics. */
#pragma once
