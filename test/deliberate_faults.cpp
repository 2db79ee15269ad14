// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// deliberate_faults <fault>: commits it; the address or the undefined behaviour sanitizer must say
// so.

#include <cstdint>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace {

struct Small
{
  int values[1];
};

struct Large
{
  int values[32];
};

Small global_object;

// What the compiler knows nothing about
template <typename T>
T hidden(T value)
{
  volatile T result = value;
  return result;
}

// Behind the end of the object, through a pointer to a larger one
int behind_the_end(Small& object) { return hidden(reinterpret_cast<Large*>(&object))->values[1]; }

// The compiler sees here which object it is.
int behind_the_end_of_a_visible_object()
{
  Small object = {{1}};
  const Large* const large = reinterpret_cast<const Large*>(&object);
  return large->values[1];
}

// The index of an array that ends inside an object
int behind_an_array()
{
  Large object = {};
  return object.values[hidden(32)];
}

int after_the_scope()
{
  const int* value = nullptr;
  {
    int local = hidden(1);
    value = hidden(&local);
  }
  return *value;
}

int commit(const std::string& fault)
{
  if(fault == "heap_object") {
    std::vector<Small> objects(1);
    return behind_the_end(objects.front());
  }
  if(fault == "local_object") {
    Small object = {{1}};
    return behind_the_end(object);
  }
  if(fault == "global_object") {
    return behind_the_end(global_object);
  }
  if(fault == "visible_object") {
    return behind_the_end_of_a_visible_object();
  }
  if(fault == "array") {
    return behind_an_array();
  }
  if(fault == "freed") {
    int* const value = new int(1);
    delete hidden(value);
    return *hidden(value);
  }
  if(fault == "scope") {
    return after_the_scope();
  }
  if(fault == "null") {
    return hidden(static_cast<Small*>(nullptr))->values[0];
  }
  if(fault == "alignment") {
    alignas(4) char bytes[8] = {};
    return *hidden(reinterpret_cast<std::int32_t*>(bytes + 1));
  }
  if(fault == "overflow") {
    return hidden(std::numeric_limits<int>::max()) + 1;
  }
  if(fault == "shift") {
    return 1 << hidden(32);
  }
  std::cerr << "no such fault: " << fault << "\n";
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  const int result = commit(argc > 1 ? argv[1] : "");
  std::cout << "nothing was seen: " << result << "\n";
}
