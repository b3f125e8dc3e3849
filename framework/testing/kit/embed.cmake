# cmake -D FROM=examples.json -D TO=kit_examples.hpp -P embed.cmake: a text as a C++ constant.
file(READ ${FROM} text)
file(WRITE ${TO} "#pragma once\nnamespace trammel::kit {\ninline constexpr const char* examples_text = R\"text(${text})text\";\n}\n")
