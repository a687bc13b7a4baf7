// Which instruction set the kernels of this run use.
#pragma once

namespace kardan {

/// Levels of x86-64: 1 (SSE2) to 4 (AVX-512).
inline constexpr int lowest_kernel_level = 2, highest_kernel_level = 4;

/// Highest level that this processor has.
int native_level();
/// Level of the kernels: what set_kernel_level() asked for, as far as the processor has it and there are kernels of it.
int kernel_level();
/// Call before the elements are made; 0 = the highest level there is. Results do not depend on it.
void set_kernel_level(int level);

/// One object of each instruction set's.
template <class T>
struct ForEachIsa {
  const T* level[highest_kernel_level - lowest_kernel_level + 1];
  const T& running() const { return *level[kernel_level() - lowest_kernel_level]; }
};

/// In namespace kardan: declares `name`, an object of `Type` that a *.isa.cpp file defines in the namespace of every instruction
/// set, and name_of_isa, of which running() is the one to use.
#define KARDAN_ISA_OBJECT(Type, name)             \
  namespace isa_v2 { extern const Type name; }    \
  namespace isa_v3 { extern const Type name; }    \
  namespace isa_v4 { extern const Type name; }    \
  inline constexpr ForEachIsa<Type> name##_of_isa{{&isa_v2::name, &isa_v3::name, &isa_v4::name}}

}  // namespace kardan
