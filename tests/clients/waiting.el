;;; waiting.el --- How the tests in Emacs wait for the other side, and fail  -*- lexical-binding: t -*-

;;; Code:

(defconst isocnc-test (file-name-base (car (last command-line-args))) "The file that is run.")

(defun isocnc-fail (format &rest arguments)
  "End with a message made of FORMAT and ARGUMENTS."
  (message "%s: %s" isocnc-test (apply #'format format arguments))
  (kill-emacs 1))

(defun isocnc-wait (condition what)
  "Wait until CONDITION gives something; WHAT is missing otherwise."
  (let ((deadline (+ (float-time) 20)) result)
    (while (not (setq result (funcall condition)))
      (when (> (float-time) deadline) (isocnc-fail "%s" what))
      (accept-process-output nil 0.05))
    result))

;;; waiting.el ends here
