#include "RockJoint.hpp"
namespace yade { YADE_PLUGIN((RockJointMat)); void RockJointMat::postLoad(RockJointMat&) {} }
