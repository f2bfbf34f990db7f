; What an editor may fold away.

(_ "{" "}") @fold
(list) @fold
(raw_string) @fold
(block_comment) @fold
(doc_comment)+ @fold
(import)+ @fold
