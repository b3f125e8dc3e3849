// trammel manual, trammel completion: the manual page and the shell's completion, from the declarations of all
// commands. Installation calls them; they are not in the list of commands.
#include "manual.hpp"

#include <fmt/format.h>

#include "simulate/results/provenance.hpp"

namespace trammel::tool {

namespace {

// troff interprets '\', and '.' or "'" at the start of a line; '-' would become a hyphen.
std::string troff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else if ((c == '.' || c == '\'') && escaped.empty())
      escaped += fmt::format("\\&{}", c);
    else
      escaped += c;
  }
  return escaped;
}

std::string page_of(const Command& command) {
  std::string text =
      fmt::format(".SS trammel {} {}\n{}\n", troff(command.name), troff(command.operand), troff(command.summary));
  for (const Option& option : command.options)
    text += fmt::format(".TP\n.B {} {}\n{}\n", troff(option.name), troff(option.value), troff(option.help));
  return text;
}

// The shell's completion of an option's value, which the help calls `value`.
const char* completed_by(std::string_view value) {
  if (value == "SCENE") return "_trammel_files .json";
  if (value == "DIR") return "_trammel_files /";
  if (value == "LIB") return "_trammel_files .so";
  if (value == "NAME")
    return "COMPREPLY=($(compgen -W \"$(trammel list --all 2>/dev/null | sed -n 's/^  \\([^ ]*\\).*/\\1/p')\" -- "
           "\"$cur\"))";
  return "_trammel_files";
}

std::string names_of(const std::vector<Command>& commands) {
  std::string names = "help";
  for (const Command& command : commands) names += fmt::format(" {}", command.name);
  return names + " --help --version";
}

std::string completion_of(const Command& command) {
  std::string text = fmt::format("    {})\n", command.name), options = "--help";
  std::string values;
  for (const Option& option : command.options) {
    options += fmt::format(" {}", option.name);
    if (!option.value.empty())
      values += fmt::format("        {}) {}; return ;;\n", option.name, completed_by(option.value));
  }
  if (!values.empty()) text += "      case $prev in\n" + values + "      esac\n";
  text += fmt::format("      if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W \"{}\" -- \"$cur\")); return; fi\n",
                      options);
  if (!command.operand.empty()) text += fmt::format("      {}\n", completed_by(command.operand));
  return text + "      ;;\n";
}

}  // namespace

std::string manual_page(const std::vector<Command>& commands) {
  std::string text = fmt::format(".TH TRAMMEL 1 \"\" \"trammel {}\"\n", simulate::build_info().version);
  text += ".SH NAME\ntrammel \\- multibody dynamics with contact\n.SH SYNOPSIS\n";
  for (const Command& command : commands)
    text += fmt::format(".B trammel {}\n{} {}\n.br\n", troff(command.name), troff(command.operand),
                        command.options.empty() ? "" : "[options]");
  text += ".SH COMMANDS\n";
  for (const Command& command : commands) text += page_of(command);
  text +=
      ".SH EXIT STATUS\n0 done, 1 the run failed (results so far are kept), 2 bad input, 3 bad plugin, "
      "130 interrupted.\n";
  text +=
      ".SH ENVIRONMENT\n.TP\n.B TRAMMEL_PLUGIN_PATH\nlibraries and folders of plugins, separated by colons\n"
      ".TP\n.B XDG_DATA_HOME\nwhere trammel/plugins is searched instead of ~/.local/share/trammel/plugins\n";
  text +=
      ".SH FILES\nExample scenes are in share/trammel/scenes beside the program's folder, plugins in lib/trammel.\n";
  return text;
}

std::string bash_completion(const std::vector<Command>& commands) {
  std::string text =
      "# bash completion of trammel, made by 'trammel completion'\n"
      "_trammel_files() {  # folders, and files with this ending; /: folders alone\n"
      "  COMPREPLY=($(compgen -d -- \"$cur\"))\n"
      "  [[ $1 == / ]] || COMPREPLY+=($(compgen -f -X \"!*$1\" -- \"$cur\"))\n"
      "}\n"
      "_trammel() {\n"
      "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} words=(\"${COMP_WORDS[@]}\") "
      "cword=$COMP_CWORD\n"
      "  if ((cword == 1)); then\n";
  text += fmt::format("    COMPREPLY=($(compgen -W \"{}\" -- \"$cur\"))\n    return\n  fi\n", names_of(commands));
  text += "  case ${words[1]} in\n";
  for (const Command& command : commands) text += completion_of(command);
  return text + "  esac\n} &&\n  complete -o filenames -F _trammel trammel\n";
}

}  // namespace trammel::tool
