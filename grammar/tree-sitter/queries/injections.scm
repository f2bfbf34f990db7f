; A script between three quotation marks is written in Rhai.

(script
  (raw_string) @injection.content
  (#set! injection.language "rhai"))
