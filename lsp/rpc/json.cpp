#include "lsp/rpc/json.h"

template class nlohmann::basic_json<>;
